#pragma once

#include <limits>

#include "tests/design/report_samples.h"

/// A small report with color, spots and hot spots.
namespace evenglow::design::samples {

inline Report report_with_metrology(const std::string& variant = "") {
  Report r = report(variant);
  ColorJudgment color;
  color.u = ramp(6, 4, 0.19);
  color.v = ramp(6, 4, 0.46);
  color.u_se = color.v_se = color.delta_se = ramp(6, 4, 0.0004);
  color.delta = ramp(6, 4, 0.002);
  color.delta.values[5] = std::numeric_limits<double>::quiet_NaN();
  color.mean = {{0.2931, 2e-4}, {0.3204, 3e-4}, {0.1876, 1e-4}, {0.4608, 2e-4}, {7776.0, 19.0}, {0.009, 1e-4}};
  color.emitted = {{0.2912, 0}, {0.3105, 0}, {0.1855, 0}, {0.4555, 0}, {8001.0, 0}, {0.008, 0}};
  color.shift = {0.0052, 2e-4};
  color.rms = 0.0031;
  color.rms_corrected = {0.00221, 0.00011};
  color.max = {0.0062, 5e-4};
  color.max_x = 7.0;
  color.max_y = 2.5;
  color.max_corrected = {0.0057, 6e-4};
  color.dark_cells = 1;
  r.color = color;
  r.angular->horizontal = HalfAngles{{-31.5, 0.4}, {32.25, 0.5}, {63.75, 0.6}};
  r.angular_spots = {{6.0, 3.0, 1.5, *r.angular}};
  r.hot_spots = {{2,
                  "left",
                  5,
                  2.6,
                  2.8,
                  {{0.75, {150, 2}, {100, 1}, {1.5, 0.025}}, {2.25, {101, 1}, {100, 1}, {1.01, 0.01}}},
                  1.5}};
  return r;
}

}  // namespace evenglow::design::samples

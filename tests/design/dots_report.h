#pragma once

#include "tests/design/report_samples.h"

namespace evenglow::design::samples {

/// A report with two rounds of real dots, the second chosen.
inline Report with_dots() {
  Report r = report();
  DotsJudgment dots;
  for (int i = 0; i < 2; ++i) {
    DotsRound round;
    round.dots = 250000 + static_cast<std::size_t>(i);
    round.area = 715.1;
    round.record.step = i;
    round.record.photons = 4000000;
    round.record.rms_corrected = {0.02 - 0.01 * i, 0.001};
    round.luminance = {990.0, 2.0};
    round.over_density = {0.99, 0.003};
    dots.rounds.push_back(round);
  }
  dots.chosen = 1;
  dots.stop_reason = "reached: <enough>";
  dots.final = r.final;
  dots.final.rms_corrected = {0.0123, 0.001};
  dots.over_density = {0.98, 0.004};
  dots.luminance = ramp(6, 4, 980.0);
  dots.luminance_se = ramp(6, 4, 10.0);
  dots.density = ramp(8, 4, 0.11);
  r.dots = dots;
  return r;
}

}  // namespace evenglow::design::samples

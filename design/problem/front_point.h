#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "design/problem/judgment.h"

namespace evenglow::design {

/// A finished design at one level of the density, judged by an independent trace.
struct FrontPoint {
  double level = 0.0;  ///< mean density that was asked for
  FinalJudgment judged;
  std::optional<core::Estimate> color;  ///< RMS in (u', v'), if there is a color receiver
  bool breaks_color = false;            ///< it passes the bound of the run file by more than its error
  core::CellField density;
  core::CellField luminance;  ///< cd/m2, of the judging trace
  std::string stop_reason;
  int steps = 0;
  int held_low = 0;  ///< cells that a limit holds at the last step
  int held_high = 0;
  std::uint64_t photons = 0;  ///< of all its traces
  double cpu_s = 0.0;
};

/// Which of the points no other one beats. b beats a if it is better in one figure (efficiency, RMS) by more than two
/// standard errors of the difference and not worse in the other by as much.
inline std::vector<bool> on_front(const std::vector<FrontPoint>& points) {
  std::vector<bool> result;
  for (const FrontPoint& a : points) {
    bool beaten = false;
    for (const FrontPoint& b : points) {
      const FinalJudgment& p = a.judged;
      const FinalJudgment& q = b.judged;
      const double brighter = (q.efficiency.value - p.efficiency.value) / std::hypot(p.efficiency.se, q.efficiency.se);
      const double evener =
          (p.rms_corrected.value - q.rms_corrected.value) / std::hypot(p.rms_corrected.se, q.rms_corrected.se);
      if ((brighter > 2.0 && evener >= -2.0) || (evener > 2.0 && brighter >= -2.0)) beaten = true;
    }
    result.push_back(!beaten);
  }
  return result;
}

}  // namespace evenglow::design

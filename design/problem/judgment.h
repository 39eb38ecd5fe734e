#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/estimate.h"
#include "design/problem/metrology.h"

/// What is said of a design: its steps, its final judgment, where the light went.
namespace evenglow::design {

/// One step of a design (a row of convergence.csv).
struct StepRecord {
  int step = 0;                  ///< from 0: the start
  std::uint64_t photons = 0;     ///< of this step's trace
  double rms = 0.0;              ///< standard deviation over mean of the luminance of the active cells
  core::Estimate rms_corrected;  ///< the Monte Carlo variance taken off; may be slightly negative (signed root)
  core::Estimate efficiency;     ///< share of the LED flux that leaves the top
  double mean_density = 0.0;     ///< of all cells of the plate
  double luminance_mean = 0.0;   ///< cd/m2
  double cpu_s = 0.0;
  double wall_s = 0.0;
  double noise = 0.0;               ///< Monte Carlo noise of a cell over the mean, as `rms` holds it
  int held_low = 0;                 ///< cells that the lower limit holds up in the density proposed next
  int held_high = 0;                ///< cells that the upper limit holds down
  std::string updater{};            ///< that proposed the next density
  std::uint64_t level_photons = 0;  ///< spent after this step on the search of the level (their time is in cpu_s)
};

/// How even the display is in one of several directions of view.
struct ViewJudgment {
  double polar_deg = 0.0, azimuth_deg = 0.0;
  double share = 0.0;  ///< of what counts
  core::Estimate rms_corrected;
  core::Estimate luminance_mean;  ///< cd/m2
};

/// The judgment of the finished design, from a trace with fresh random numbers. Without light on the display there is
/// no evenness: RMS and uniformities are not a number.
struct FinalJudgment {
  std::uint64_t photons = 0;
  double rms = 0.0;
  core::Estimate rms_corrected;
  double uniformity_9 = 0.0;      ///< minimum over maximum of 9 spots
  double uniformity_13 = 0.0;     ///< of 13 spots
  core::Estimate luminance_mean;  ///< cd/m2
  double luminance_center = 0.0;  ///< cd/m2
  core::Estimate efficiency;
  std::vector<ViewJudgment> views{};  ///< of several directions of view; else empty
  double rms_low = 0.0;               ///< 95 % confidence interval of the RMS without noise
  double rms_high = 0.0;
  /// Standard errors of the spots' figures (`spot_errors`); not a number where they are not known.
  double uniformity_9_se = std::numeric_limits<double>::quiet_NaN();
  double uniformity_13_se = std::numeric_limits<double>::quiet_NaN();
  double luminance_center_se = std::numeric_limits<double>::quiet_NaN();  ///< cd/m2
};

/// A named share of the emitted flux.
struct EnergyShare {
  std::string name;
  core::Estimate share;  ///< of the emitted flux, 0 to 1
};

/// Where the light went; all shares sum to 1.
struct EnergyAccount {
  double emitted_lm = 0.0;
  std::vector<EnergyShare> escaped;   ///< left, right, front, back, bottom, top
  std::vector<EnergyShare> absorbed;  ///< a row for each named part
  core::Estimate lost;
};

/// Luminance of the display averaged over the active area, by direction of view.
struct AngularLuminance {
  std::vector<double> polar_deg;  ///< edges of the polar bins, 0 to 90, size n_polar + 1
  int azimuth_count = 0;          ///< equal bins of azimuth from 0 to 360 degrees; bin i begins at i * 360 / count
  std::vector<core::Estimate> luminance;   ///< cd/m2, index polar * azimuth_count + azimuth
  std::optional<HalfAngles> horizontal{};  ///< in the plane of x
  std::optional<HalfAngles> vertical{};    ///< in the plane of y
};

/// The same of a disc of the display.
struct SpotLuminance {
  double x = 0.0, y = 0.0;  ///< center, mm
  double diameter = 0.0;    ///< mm
  AngularLuminance angular;
};

}  // namespace evenglow::design

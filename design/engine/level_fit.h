#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/montecarlo/estimate.h"

/// Efficiency against the level (mean density), as a smooth saturating curve.
namespace evenglow::design {

/// E(l) = limit (1 - (1 + l / (k scale))^-k) (1 - decline l). The first factor grows and saturates: k = 1 is the
/// hyperbola of a cavity in which dots and losses compete at equal rates everywhere, k = infinity the exponential of
/// light that runs along the plate once; the last one lets it fall again where the microstructure itself absorbs.
struct LevelCurve {
  double limit = 0.0;
  double scale = 1.0;    ///< level
  double k = 1.0;        ///< >= 1; infinity allowed
  double decline = 0.0;  ///< 1 / level, >= 0
  double chi_square = 0.0;

  double at(double level) const;
};

/// Measured efficiencies at several levels and their covariance (common random numbers make it one).
struct LevelData {
  std::vector<double> levels;  ///< > 0, rising
  Eigen::VectorXd efficiency;
  Eigen::MatrixXd covariance;
};

/// Generalized least squares: limit and decline linear, scale by a search, k among 1, 2, 4 and infinity. At least 3
/// levels.
LevelCurve fit_level_curve(const LevelData& data);

/// The lowest level in [low, high] at which the curve reaches `share` of its greatest value there; continuous in the
/// data.
double knee_of(const LevelCurve& curve, double share, double low, double high);

/// The knee of the fitted curve, with the standard error of its logarithm carried over from the covariance.
struct Knee {
  double level = 0.0;
  double log_se = 0.0;
  LevelCurve curve;
};
Knee find_knee(const LevelData& data, double share, double low, double high);

/// The lowest level in [low, high] at which the curve reaches the efficiency; `high` if it does not.
double level_of(const LevelCurve& curve, double efficiency, double low, double high);

}  // namespace evenglow::design

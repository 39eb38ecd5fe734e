#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tracer/polarized_bsdf/lobe_parameters.h"
#include "tracer/polarized_bsdf/luminance_metrics.h"
#include "tracer/polarized_bsdf/luminance_table.h"

namespace evenglow::tracer {

/// Set-up of a measurement at normal incidence.
struct LuminanceSetup {
  double throughput = 0.9;           ///< K = k1 + k2 of the filter, taken as ideal otherwise
  double offset_reflection = 0.0;    ///< rad, from psi to the axis of polarization that the filter's scale sees
  double offset_transmission = 0.0;  ///< rad
};

/// Luminance (cd/m2) that the model with c = 1 shows at normal incidence, at theta in the plane phi = 0:
///
///     L_nat = (f_p + f_b) e0 / 2,     L_lpf = K e0 / 2 [(f_p + f_b) / 2 + (f_p - f_b) / 2 cos 2 (filter - psi -
///     offset)]
double lobe_luminance(const LobeParameters& parameters, const LuminanceSetup& setup, ScatterKind kind,
                      const LuminanceRow& row);

struct LobeFitOptions {
  double relative_error = 0.1;         ///< of a reading
  double absolute_error = 0.05;        ///< cd/m2; the two are added
  double absorption = 0.015;           ///< of light of either polarization
  double loss_width = 1.0;             ///< w of a Cauchy loss w^2 ln(1 + r^2/w^2), in errors; 0: plain least squares
  std::optional<double> throughput{};  ///< K held at this value; none: fitted
  LobeParameters start{};              ///< amplitudes are scaled to the readings first
};

struct FittedValue {
  std::string key;  ///< as in `lobe_parameters()`; `throughput`, `offset_reflection_deg`, `offset_transmission_deg`
  double value = 0.0;
  double se = 0.0;  ///< infinite where the readings do not tell; 0: held
};

struct LobeFit {
  LobeParameters parameters;
  LuminanceSetup setup;
  std::vector<FittedValue> values;  ///< all parameters with standard errors
  double chi_square = 0.0;          ///< with the errors of the options
  int degrees_of_freedom = 0;
  int iterations = 0;
  bool converged = false;
  std::vector<std::string> remarks;           ///< parameters that the readings do not tell apart, one sentence each
  LuminanceMetrics reflection, transmission;  ///< of the readings fitted
};

/// Least-squares fit of the model's widths and amplitudes, of the filter's throughput and of the two offsets to
/// readings at normal incidence (Ceres, Levenberg-Marquardt, derivatives by automatic differentiation). Energy is a
/// constraint, met exactly: e0, a1 and b1 obey R_p + T_p = R_b + T_b = 1 - absorption with the integrals at normal
/// incidence
/// (`lobe_integral`), which is what sets e0. Standard errors come from the scatter of the residuals, carried over
/// to a1 and b1. Throws `core::Error` if there are fewer readings than parameters or no fit keeps the constraint.
LobeFit fit_lobes(const LuminanceTable& reflection, const LuminanceTable& transmission, const LobeFitOptions& options);

/// k-fold cross-validation: the readings (both tables, shuffled by `seed`) are parted into `folds`, each is predicted
/// by a fit to the others that starts from `start`. Held-out readings against predictions.
struct CrossValidation {
  int folds = 0;
  LuminanceMetrics reflection, transmission;
  double chi_square = 0.0;  ///< per held-out reading
};
CrossValidation cross_validate(const LuminanceTable& reflection, const LuminanceTable& transmission,
                               const LobeFitOptions& options, int folds, std::uint64_t seed = 1);

}  // namespace evenglow::tracer

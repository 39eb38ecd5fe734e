#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/montecarlo/estimate.h"
#include "tracer/goniometer/goniometer_spec.h"
#include "tracer/polarized_bsdf/luminance_metrics.h"

namespace evenglow::tracer {

/// What the detector reads at one setting. Luminances in cd/m2, means over the acceptance cone C about the direction of
/// the detector,
///
///     L = E integral_C f cos dOmega / integral_C cos dOmega,     integral_C cos dOmega = pi sin^2(acceptance)
///     cos(detector)
///
/// with E the illuminance behind the filter.
struct GoniometerRow {
  ScatterKind kind = ScatterKind::reflection;
  LuminanceRow setting;         ///< `measured` and `published` negative where there are none
  std::optional<double> table;  ///< from the film's table itself, if it has one
  double film = 0.0;            ///< from `Bsdf::evaluate` of the film in use
  core::Estimate traced;        ///< from photons scattered by `Bsdf::sample`
  double expected_hits = 0.0;   ///< of the detector, from `film`
  double hits = 0.0;
  double z = 0.0;  ///< (hits - expected) over the binomial standard error of the expectation
};

/// Do tracing and evaluation agree? Over the rows that expect at least 20 hits.
struct GoniometerAgreement {
  double chi_square = 0.0;  ///< sum of z^2
  int rows = 0;             ///< that count: the degrees of freedom, as nothing is fitted
  double largest_z = 0.0;   ///< of them, absolute
  double per_degree() const { return rows > 0 ? chi_square / rows : 0.0; }
};

struct GoniometerResult {
  std::vector<GoniometerRow> rows;  ///< kind, psi, theta, illumination (natural first); the last fastest
  GoniometerAgreement agreement;
  std::uint64_t photons = 0;  ///< in all
};

struct GoniometerTrace {
  std::uint64_t photons = 0;  ///< of each setting of lamp, filter and film; a multiple of `batches`; 0: none
  std::size_t batches = 100;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all
  std::stop_token stop{};
  std::function<void(std::uint64_t)> progress{};  ///< photons done so far; from any thread, one call at a time
};

/// All settings of the spec. Empty if it was stopped.
std::optional<GoniometerResult> measure(const GoniometerSpec& spec, const GoniometerTrace& trace);
/// Settings that will be traced, and so photons = settings x trace.photons.
std::size_t traced_settings(const GoniometerSpec& spec);

/// One column of the result against the measured one; rows without either are left out. `kind` empty: both together.
enum class GoniometerColumn { published, table, film, traced };
LuminanceMetrics goniometer_metrics(const GoniometerResult& result, GoniometerColumn column,
                                    std::optional<ScatterKind> kind);

/// BSDF (1/sr) behind an ideal polarizer at `angle` (rad, from e1 of the incident ray), towards theta in the plane of
/// incidence: the readings of figure 5 of the paper.
double filtered_bsdf(const GoniometerSpec& spec, ScatterKind kind, double psi, double angle, double theta);

}  // namespace evenglow::tracer

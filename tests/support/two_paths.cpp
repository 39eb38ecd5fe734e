#include "tests/support/two_paths.h"

#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

core::Estimate difference(const core::Estimate& a, const core::Estimate& b) {
  return {a.value - b.value, std::hypot(a.se, b.se)};
}

/// Entries with so few photons are told from one another by chance alone: their spread is no Gaussian's.
constexpr double kFewPhotons = 50.0;

}  // namespace

TwoPaths traced_by_both(const tracer::Scene& scene, const tracer::DensityField& density, const TraceSetup& setup) {
  return traced_by(tracer::TracePath::kGeneral, tracer::TracePath::kPlanar, scene, density, setup);
}

TwoPaths traced_by(tracer::TracePath first, tracer::TracePath second, const tracer::Scene& scene,
                   const tracer::DensityField& density, const TraceSetup& setup) {
  const auto run = [&](tracer::TracePath path, std::uint64_t seed) {
    tracer::TraceOptions options;
    options.photons = tracer::whole_batches(setup.photons, setup.batches);
    options.batches = setup.batches;
    options.key.seed = seed;
    options.threads = setup.threads;
    options.path = path;
    auto result = tracer::trace(scene, density, options);
    core::expects(result.has_value(), "nobody stops the trace of a test");
    return std::move(*result);
  };
  return {run(first, setup.seed), run(second, setup.seed + 1)};
}

PathDifference difference_of(const tracer::Scene& scene, const TwoPaths& paths) {
  PathDifference result;
  const auto compare = [&result](const core::Estimate& a, const core::Estimate& b, const std::string& name) {
    ++result.comparisons;
    const double z = std::abs(z_score(difference(a, b), 0.0));
    if (z < result.worst_z) return;
    result.worst_z = z;
    result.worst_entry = name;
  };
  const auto& parts = scene.energy.parts();
  for (std::size_t bin = 0; bin < paths.general.energy.bins(); ++bin) {
    const core::Estimate a = paths.general.energy.total(bin);
    const core::Estimate b = paths.planar.energy.total(bin);
    if (a.value + b.value < kFewPhotons) continue;
    const bool is_part = bin >= tracer::kSides && bin < tracer::kSides + parts.size();
    compare(a, b, is_part ? parts[bin - tracer::kSides] : "bin " + std::to_string(bin));
  }
  const auto& general = paths.general.luminance;
  const auto& planar = paths.planar.luminance;
  const std::vector<double> ones(general.bins(), 1.0);
  compare(general.weighted_total(ones), planar.weighted_total(ones), "mean luminance");
  for (std::size_t bin = 0; bin < general.bins(); ++bin) {
    const core::Estimate d = difference(general.total(bin), planar.total(bin));
    if (d.se <= 0.0) continue;
    result.chi_square += std::pow(d.value / d.se, 2);
    ++result.cells;
  }
  result.events_ratio = paths.planar.events / paths.general.events;
  return result;
}

}  // namespace evenglow::tests

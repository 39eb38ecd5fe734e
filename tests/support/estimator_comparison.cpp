#include "tests/support/estimator_comparison.h"

#include <cmath>

#include "tests/support/chi_square.h"

namespace evenglow::tests {

EstimatorComparison compare_estimators(const std::string& backlight, const std::string& next_receiver,
                                       const std::string& count_receiver, const TraceSetup& next,
                                       const TraceSetup& count, const char* estimator) {
  const auto text = [&](const char* by, const std::string& receiver) {
    return backlight + ", receivers: [{kind: luminance, " + receiver + ", estimator: " + by + "}]";
  };
  const Traced a(text(estimator, next_receiver), next);
  const Traced b(text("counting", count_receiver), count);
  const core::Estimate La = a.mean_luminance(), Lb = b.mean_luminance();
  const double se = std::hypot(La.se, Lb.se);
  EstimatorComparison result;
  result.z_mean = (La.value - Lb.value) / se;
  result.se_mean = se / Lb.value;
  const tracer::LuminanceMap ma = a.map(), mb = b.map();
  for (std::size_t i = 0; i < ma.luminance.values.size(); ++i) {
    const double d = ma.luminance.values[i] - mb.luminance.values[i];
    const double s2 = std::pow(ma.standard_error.values[i], 2) + std::pow(mb.standard_error.values[i], 2);
    result.chi2 += d * d / s2;
    ++result.cells;
  }
  // The variances come from the spread of the batches (Student): the mean of z^2 is (B - 1) / (B - 3) of the noisier
  // run.
  const double B = static_cast<double>(count.batches);
  result.chi2 *= (B - 3.0) / (B - 1.0);
  result.chance = chi_square_tail(result.chi2, result.cells);
  return result;
}

}  // namespace evenglow::tests

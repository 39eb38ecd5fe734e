#include "tests/support/chi_square.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::tests {

double chi_square_tail(double statistic, double degrees) {
  const double a = 0.5 * degrees;
  const double x = 0.5 * statistic;
  if (x <= 0.0) return 1.0;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1.0) {  // series of the lower function (Abramowitz & Stegun 6.5.29)
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > 1e-16 * sum; n += 1.0) {
      term *= x / n;
      sum += term;
    }
    return std::max(0.0, 1.0 - front * sum);
  }
  // Continued fraction of the upper function (6.5.31), by the method of Lentz.
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double fraction = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = 1.0 / (an * d + b);
    c = b + an / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return front * fraction;
}

ChiSquareResult chi_square_test(std::span<const double> counts, std::span<const double> expected, double least) {
  core::expects(counts.size() == expected.size(), "one expectation for each count");
  ChiSquareResult result;
  double seen = 0.0, hoped = 0.0;
  double last_seen = 0.0, last_hoped = 0.0;
  int bins = 0;
  const auto close = [&](double s, double e) { result.statistic += (s - e) * (s - e) / e; };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    seen += counts[i];
    hoped += expected[i];
    if (hoped < least) continue;
    if (bins > 0) close(last_seen, last_hoped);
    last_seen = seen;
    last_hoped = hoped;
    seen = hoped = 0.0;
    ++bins;
  }
  // The rest, too small for a bin, joins the last one.
  if (bins > 0) close(last_seen + seen, last_hoped + hoped);
  result.degrees = bins - 1;
  if (result.degrees >= 1) result.p_value = chi_square_tail(result.statistic, result.degrees);
  return result;
}

}  // namespace evenglow::tests

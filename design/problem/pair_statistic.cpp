#include "design/problem/pair_statistic.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// (1/2 / 0.893)^2: the signed root of a normal number of mean 0 and unit width scatters by 0.893.
constexpr double kLost = 0.3133;

}  // namespace

core::Estimate pair_statistic(const BatchProducts& h) {
  const std::size_t B = h.batches();
  core::expects(B >= 3, "at least 3 batches");
  const double n = static_cast<double>(B);
  std::vector<double> row(B, 0.0);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t b = 0; b < B; ++b) {
    for (std::size_t c = 0; c < b; ++c) {
      const double value = h.at(b, c);
      row[b] += value;
      row[c] += value;
      sum += value;
      squares += value * value;
    }
  }
  const double pairs = 0.5 * n * (n - 1.0);
  const double mean = sum / pairs;
  const double zeta2 = std::max(0.0, squares / pairs - mean * mean);
  double between = 0.0;
  for (const double r : row) between += (r / (n - 1.0) - mean) * (r / (n - 1.0) - mean);
  // The spread of the row means holds zeta_1 and, through the finite rows, a share of zeta_2.
  const double zeta1 = std::max(0.0, between / (n - 1.0) - zeta2 / (n - 1.0));
  return {mean, std::sqrt(4.0 * (n - 2.0) / (n * (n - 1.0)) * zeta1 + 2.0 / (n * (n - 1.0)) * zeta2)};
}

core::Estimate signed_root(double square, double se) {
  const double root = std::copysign(std::sqrt(std::abs(square)), square);
  if (!(se > 0.0)) return {root, 0.0};
  return {root, 0.5 * std::sqrt(se / std::max(std::abs(square) / se - 1.0, kLost))};
}

core::Estimate signed_square(const core::Estimate& root) {
  const double size = std::abs(root.value), square = root.value * size;
  if (!(root.se > 0.0)) return {square, 0.0};
  const double lost = 4.0 * kLost * root.se * root.se;  // the error of a square that is lost in it
  if (size * size <= (1.0 + kLost) * lost) return {square, lost};
  const double inverse = size / root.se;
  return {square, 2.0 * size * size / (1.0 + std::sqrt(1.0 + inverse * inverse))};
}

}  // namespace evenglow::design

#include "design/updaters/box_blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace evenglow::design {
namespace {

constexpr int kPasses = 3;

/// Half width of the running mean: kPasses of width 2 r + 1 have the variance kPasses ((2 r + 1)^2 - 1) / 12.
int radius_of(double sigma) {
  return static_cast<int>(std::lround(0.5 * (std::sqrt(12.0 * sigma * sigma / kPasses + 1.0) - 1.0)));
}

/// Running mean of `line` over 2 radius + 1 values; the sum moves along, and begins anew at each line, so that rounding
/// does not pile up.
void running_mean(const std::vector<double>& line, int radius, std::vector<double>& out) {
  const int n = static_cast<int>(line.size());
  const auto reflected = [&](int i) {
    const int period = 2 * n;
    i = ((i % period) + period) % period;
    return line[static_cast<std::size_t>(i < n ? i : period - 1 - i)];
  };
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) sum += reflected(k);
  const double width = 2.0 * radius + 1.0;
  for (int i = 0; i < n; ++i) {
    out[static_cast<std::size_t>(i)] = std::max(0.0, sum / width);
    sum += reflected(i + radius + 1) - reflected(i - radius);
  }
}

void blur_lines(core::CellField& field, bool along_x, int radius) {
  const auto nx = static_cast<std::size_t>(field.grid.nx);
  const auto ny = static_cast<std::size_t>(field.grid.ny);
  const std::size_t length = along_x ? nx : ny;
  const std::size_t stride = along_x ? 1 : nx;
  std::vector<double> line(length);
  std::vector<double> out(length);
  for (std::size_t k = 0; k < (along_x ? ny : nx); ++k) {
    double* first = field.values.data() + k * (along_x ? nx : 1);
    for (std::size_t i = 0; i < length; ++i) line[i] = first[i * stride];
    for (int pass = 0; pass < kPasses; ++pass) {
      running_mean(line, radius, out);
      line.swap(out);
    }
    for (std::size_t i = 0; i < length; ++i) first[i * stride] = line[i];
  }
}

}  // namespace

core::CellField blur(core::CellField field, double sigma_x, double sigma_y) {
  const int x = radius_of(sigma_x);
  const int y = radius_of(sigma_y);
  if (x > 0) blur_lines(field, true, x);
  if (y > 0) blur_lines(field, false, y);
  return field;
}

}  // namespace evenglow::design

#include "design/tolerance/noise_shift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "design/problem/merit.h"
#include "design/tolerance/figures.h"

namespace evenglow::design {
namespace {

void add_batches(const core::Tally& tally, std::size_t from, std::size_t to, core::CellField& sum) {
  for (std::size_t b = from; b < to; ++b) {
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += tally.batch(b)[i];
  }
}

}  // namespace

std::vector<core::Estimate> noise_shift(const core::Tally& luminance, const core::CellGrid& grid,
                                        std::uint64_t all_photons, std::uint64_t photons) {
  std::vector<core::Estimate> shift(kFigures.size());
  const auto nine = static_cast<std::size_t>(figure_index("uniformity_9"));
  const auto thirteen = static_cast<std::size_t>(figure_index("uniformity_13"));
  const double each = static_cast<double>(all_photons) / static_cast<double>(luminance.batches());
  const auto size = static_cast<std::size_t>(std::max(1.0, std::round(static_cast<double>(photons) / each)));
  const std::size_t groups = luminance.batches() / size;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (groups < 4) {
    shift[nine] = shift[thirteen] = {kUnknown, kUnknown};
    return shift;
  }
  core::CellField whole(grid, 0.0);
  add_batches(luminance, 0, luminance.batches(), whole);
  const double noise = std::sqrt(each * static_cast<double>(size) / static_cast<double>(photons));
  const auto count = static_cast<double>(groups);
  for (const auto& [index, figure] : {std::pair{nine, &uniformity_9}, std::pair{thirteen, &uniformity_13}}) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t g = 0; g < groups; ++g) {
      core::CellField part(grid, 0.0);
      add_batches(luminance, g * size, (g + 1) * size, part);
      const double difference = noise * (figure(part) - figure(whole));
      sum += difference;
      squares += difference * difference;
    }
    const double variance = std::max(0.0, (squares - sum * sum / count) / (count - 1.0));
    shift[index] = {sum / count, std::sqrt(variance / count)};
  }
  return shift;
}

}  // namespace evenglow::design

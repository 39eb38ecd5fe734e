#include "tracer/transport/rank_sums.h"

#include <algorithm>
#include <iterator>

#include "core/base/error.h"
#include "tracer/microstructure/dot_grid.h"

namespace evenglow::tracer {
namespace {

constexpr std::vector<double> BatchSums::*kParts[] = {&BatchSums::luminance, &BatchSums::color_x, &BatchSums::color_z,
                                                      &BatchSums::energy,    &BatchSums::angular, &BatchSums::events};

std::vector<double> flat(const BatchSums& sums) {
  std::vector<double> numbers;
  for (const auto part : kParts) numbers.insert(numbers.end(), (sums.*part).begin(), (sums.*part).end());
  return numbers;
}

std::unique_ptr<BatchSums> from_flat(const Scene& scene, const std::vector<double>& numbers) {
  auto sums = std::make_unique<BatchSums>(scene);
  auto at = numbers.begin();
  for (const auto part : kParts) {
    std::vector<double>& bins = (*sums).*part;
    core::expects(static_cast<std::size_t>(numbers.end() - at) >= bins.size(), "a rank sends all bins of a batch");
    std::copy_n(at, bins.size(), bins.begin());
    at += static_cast<std::ptrdiff_t>(bins.size());
  }
  core::expects(at == numbers.end(), "a rank sends no other bins");
  return sums;
}

}  // namespace

core::Agreement agreement_on(const Scene& scene, const DensityField& density, const TraceOptions& options) {
  core::Agreement agreement;
  agreement.add(options.photons).add(options.batches).add(options.record_bytes);
  agreement.add(options.key.seed).add(options.key.stream).add(options.key.step);
  agreement.add(scene.luminance.bins())
      .add(scene.energy.bins())
      .add(std::vector<double>{scene.flux})
      .add(density.cells.values);
  agreement.add(density.dots ? density.dots->size() : std::size_t{0});
  return agreement;
}

void share_sums(core::RankGroup& ranks, const std::vector<std::size_t>& own, const Scene& scene, BatchResults& sums,
                const std::stop_token& stop) {
  if (ranks.count() == 1) return;
  std::vector<std::vector<double>> numbers(sums.size());
  for (const std::size_t i : own) numbers[i] = flat(*sums[i]);
  ranks.share(own, numbers, stop);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!sums[i]) sums[i] = from_flat(scene, numbers[i]);
  }
}

}  // namespace evenglow::tracer

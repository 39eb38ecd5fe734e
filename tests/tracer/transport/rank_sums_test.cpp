#include "tracer/transport/rank_sums.h"

#include <cstring>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"
#include "tests/support/thread_ranks.h"

/// A trace that ranks share (threads of this process), its records among them, against the same trace alone.
namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [8, 4], density: "
    "0.2, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 2, reflectance: 0.5}], reflectors: "
    "{bottom: {}, right: {}}, films: [{kind: diffuser}, {kind: dbef}], receivers: [{kind: luminance, cells: [8, 4], "
    "cone_deg: 30}, {kind: angular}]";

/// The bits of all that a trace of `photons` photons gives, and of what its records say of another density.
std::string bits_of_trace(const Scene& scene, core::RankGroup* ranks, std::size_t record_bytes) {
  TraceOptions options;
  options.photons = 6000;
  options.batches = 30;
  options.threads = 2;
  options.record_bytes = record_bytes;
  options.ranks = ranks;
  const DensityField density = initial_density(scene.spec);
  const auto result = trace(scene, density, options);
  if (!result) return "";
  std::string bits;
  const auto append = [&](double value) { bits.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const auto add = [&](const core::Tally& tally) {
    for (std::size_t batch = 0; batch < tally.batches(); ++batch) {
      for (const double value : tally.batch(batch)) append(value);
    }
  };
  for (const core::Tally* tally : {&result->luminance, &result->energy, &result->angular}) add(*tally);
  append(result->events);
  if (!result->records) return bits;
  DensityField other = density;
  for (std::size_t i = 0; i < other.cells.values.size(); ++i) other.cells.values[i] *= 1.0 + 0.01 * i;
  const Reweighted moved = result->records->at(other);
  add(moved.luminance);
  append(moved.effective_share);
  append(static_cast<double>(moved.photons));
  append(static_cast<double>(result->records->bytes()));
  add(result->records->derivative(other, other.cells));
  return bits;
}

TEST(RankSums, ATraceHasTheSameBitsOnAnyNumberOfRanks) {
  const Scene scene = scene_of(kBacklight);
  // None, all, and the first few photons of each batch.
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{64} << 20, std::size_t{200} << 10}) {
    const std::string alone = bits_of_trace(scene, nullptr, bytes);
    ASSERT_FALSE(alone.empty());
    for (const int count : {2, 3, 4}) {
      on_ranks(count, [&](int rank, std::unique_ptr<core::RankLink> link) {
        core::RankGroup ranks(std::move(link));
        EXPECT_TRUE(bits_of_trace(scene, &ranks, bytes) == alone) << "rank " << rank << " of " << count;
        ranks.finish("", 0);
      });
    }
  }
}

TEST(RankSums, TracesOfOtherDensitiesDoNotAgree) {
  const Scene scene = scene_of(kBacklight);
  const DensityField density = initial_density(scene.spec);
  DensityField other = density;
  other.cells.values[3] *= 1.0 + 1e-15;
  const TraceOptions options;
  const auto agreed = agreement_on(scene, density, options).value();
  EXPECT_EQ(agreement_on(scene, density, options).value(), agreed);
  EXPECT_NE(agreement_on(scene, other, options).value(), agreed);
  TraceOptions later;
  later.key.step = 1;
  EXPECT_NE(agreement_on(scene, density, later).value(), agreed);
}

}  // namespace
}  // namespace evenglow::tests

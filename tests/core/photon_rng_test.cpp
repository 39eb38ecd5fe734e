#include "core/montecarlo/photon_rng.h"

#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/z_test.h"

/// False alarms: 1e-3 for each test; seeds fixed.
namespace evenglow::core {
namespace {

std::vector<double> numbers(const RandomKey& key, std::uint64_t photon, int count) {
  PhotonRng rng(key, photon);
  std::vector<double> result;
  for (int i = 0; i < count; ++i) result.push_back(rng.uniform());
  return result;
}

/// The state is the known answer of Philox4x64-10 for counter 0 and key 0 (the file kat_vectors of Random123); from it
/// xoshiro256+ as its authors define it: result s0 + s3; then s2 ^= s0, s3 ^= s1, s1 ^= s2, s0 ^= s3, s2 ^= s1 << 17
/// (of the old s1), s3 rotated left by 45. Worked out by hand for the first two.
TEST(PhotonRng, KnownAnswer) {
  const std::uint64_t s0 = 0x16554d9eca36314cULL, s1 = 0xdb20fe9d672d0fdcULL, s2 = 0xd7e772cee186176bULL,
                      s3 = 0x7e68b68aec7ba23bULL;
  const std::uint64_t moved3 = s3 ^ s1;
  const std::uint64_t words[] = {s0 + s3, (s0 ^ moved3) + ((moved3 << 45) | (moved3 >> 19))};
  (void)s2;  // the second number does not depend on it
  PhotonRng rng({0, 0, 0}, 0);
  for (const std::uint64_t word : words) EXPECT_EQ(rng.uniform(), (static_cast<double>(word >> 11) + 0.5) * 0x1.0p-53);
}

TEST(PhotonRng, SameKeySameNumbers) {
  EXPECT_EQ(numbers({5, 2, 3}, 77, 50), numbers({5, 2, 3}, 77, 50));
}

TEST(PhotonRng, EveryFieldChangesAllNumbers) {
  const std::vector<std::vector<double>> runs = {
      numbers({5, 2, 3}, 77, 100),          numbers({6, 2, 3}, 77, 100),         numbers({5, 3, 3}, 77, 100),
      numbers({5, 2, 4}, 77, 100),          numbers({5, 2, 3}, 78, 100),         numbers({5, 3, 2}, 77, 100),
      numbers({5ULL << 32, 2, 3}, 77, 100), numbers({5, 2, 3}, 77ULL << 32, 100)};
  std::set<double> all;
  for (const auto& run : runs) all.insert(run.begin(), run.end());
  EXPECT_EQ(all.size(), runs.size() * 100);
}

TEST(PhotonRng, IsUniformAndOpen) {
  constexpr int kBins = 1000;
  std::vector<double> counts(kBins, 0.0);
  double sum = 0.0, squares = 0.0, neighbors = 0.0;
  constexpr int kPhotons = 20000, kDraws = 50;
  double last = 0.5;
  for (int photon = 0; photon < kPhotons; ++photon) {
    PhotonRng rng({20260101, 0, 0}, static_cast<std::uint64_t>(photon));
    for (int i = 0; i < kDraws; ++i) {
      const double u = rng.uniform();
      ASSERT_GT(u, 0.0);
      ASSERT_LT(u, 1.0);
      counts[static_cast<std::size_t>(u * kBins)] += 1.0;
      sum += u;
      squares += (u - 0.5) * (u - 0.5);
      neighbors += (u - 0.5) * (last - 0.5);
      last = u;
    }
  }
  constexpr double n = kPhotons * kDraws;
  const std::vector<double> expected(kBins, n / kBins);
  EXPECT_GT(tests::chi_square_test(counts, expected).p_value, tests::sidak(1e-3, 4));
  const double limit = tests::z_limit(1e-3, 4);
  EXPECT_LT(std::abs((sum / n - 0.5) / std::sqrt(1.0 / 12.0 / n)), limit);
  EXPECT_LT(std::abs((squares / n - 1.0 / 12.0) / std::sqrt(1.0 / 180.0 / n)), limit);
  EXPECT_LT(std::abs(neighbors / n / std::sqrt(1.0 / 144.0 / n)), limit);
}

/// Do the pairs fill the square evenly? `pair(field, a, b)`: in [0, 1)^2, of the key a of a pair and a key b that
/// differs from it in its seed (field 1), in its stream (2) or not at all. False alarm 1e-3 for all fields together.
template <typename Pair>
void expect_independent(int fields, const Pair& pair) {
  constexpr int kSide = 16;
  constexpr int kPairs = 100000;
  const double chance = tests::sidak(1e-3, static_cast<std::size_t>(fields));
  for (int field = 0; field < fields; ++field) {
    std::vector<double> counts(kSide * kSide, 0.0);
    for (std::uint32_t i = 0; i < kPairs; ++i) {
      const RandomKey a{1, 0, i};
      RandomKey b = a;
      if (field == 1) b.seed = 2;
      if (field == 2) b.stream = 1;
      const auto [x, y] = pair(field, a, b);
      counts[static_cast<std::size_t>(x * kSide) * kSide + static_cast<std::size_t>(y * kSide)] += 1.0;
    }
    const std::vector<double> expected(counts.size(), static_cast<double>(kPairs) / (kSide * kSide));
    EXPECT_GT(tests::chi_square_test(counts, expected).p_value, chance) << field;
  }
}

/// The first draws of neighboring photons, of neighboring seeds and of neighboring streams.
TEST(PhotonRng, NeighboringKeysAreIndependent) {
  expect_independent(3, [](int field, const RandomKey& a, const RandomKey& b) {
    return std::pair(PhotonRng(a, 7).uniform(), PhotonRng(b, field == 0 ? 8 : 7).uniform());
  });
}

/// The words of a photon's second generator with those of its neighbors and with its first.
TEST(LaneWords, AreIndependentOfNeighborsAndOfTheFirstGenerator) {
  expect_independent(4, [](int field, const RandomKey& a, const RandomKey& b) {
    const auto word = [&a](const RandomKey& key, std::uint64_t photon) {
      return lane_words(key, photon)[a.step % 4] * 0x1.0p-32;
    };
    return std::pair(word(a, 7), field == 3 ? PhotonRng(a, 7).uniform() : word(b, field == 0 ? 8 : 7));
  });
}

}  // namespace
}  // namespace evenglow::core

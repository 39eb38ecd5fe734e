#pragma once

#include <cstdint>
#include <numeric>

#include <gtest/gtest.h>

#include "tracer/transport/batch_sums.h"

/// For every path: what becomes of single photons.
namespace evenglow::tests {

/// Photons that the energy account of a batch knows of.
inline double account(const tracer::BatchSums& sums) {
  return std::accumulate(sums.energy.begin(), sums.energy.end(), 0.0);
}

inline void expect_same_sums(const tracer::BatchSums& a, const tracer::BatchSums& b) {
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.angular, b.angular);
  EXPECT_EQ(a.events, b.events);
}

/// Each photon adds 1 to the account, and its fate depends on its key and index alone: whatever came before.
template <typename History>
void expect_photons_end_once_and_alone(const tracer::Scene& scene, const History& history, std::uint64_t photons) {
  tracer::BatchSums forward(scene), backward(scene);
  for (std::uint64_t i = 0; i < photons; ++i) {
    history.run({1, 2, 3}, i, forward);
    ASSERT_EQ(account(forward), static_cast<double>(i + 1));
  }
  for (std::uint64_t i = photons; i-- > 0;) history.run({1, 2, 3}, i, backward);
  expect_same_sums(forward, backward);
}

}  // namespace evenglow::tests

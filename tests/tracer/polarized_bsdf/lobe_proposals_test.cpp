#include "tracer/polarized_bsdf/lobe_proposals.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

/// Weights over nine decades, with a whole row, the first and the last block empty.
std::vector<double> uneven_weights() {
  std::vector<double> weights;
  for (std::size_t i = 0; i < LobeProposals::kBlocks; ++i) weights.push_back(std::exp(-0.065 * static_cast<double>(i)));
  for (std::size_t c = 0; c < LobeProposals::kColumns; ++c) weights[3 * LobeProposals::kColumns + c] = 0.0;
  weights.front() = weights.back() = 0.0;
  return weights;
}

TEST(LobeProposals, EveryBlockIsDrawnWithTheOddsThatItTells) {
  LobeProposals proposals;
  proposals.add(std::vector<double>(LobeProposals::kBlocks, 1.0));  // so that the second is not the first
  const std::vector<double> weights = uneven_weights();
  proposals.add(weights);
  std::vector<double> share(LobeProposals::kBlocks, 0.0);
  constexpr int kSteps = 1 << 20;
  for (int i = 0; i < kSteps; ++i) {
    const auto block = proposals.draw(1, (i + 0.5) / kSteps);
    const std::size_t index = block.row * LobeProposals::kColumns + block.column;
    ASSERT_GE(block.weight, weights[index]);
    // Rounded up by one count at most.
    ASSERT_LE(block.weight, weights[index] + proposals.total(1) / 60000);
    share[index] += 1.0 / kSteps;
    ASSERT_GT(weights[index], 0.0);
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    // What a block tells of itself is what it is drawn with.
    double at = 0.0;
    for (std::size_t j = 0; j < i; ++j) at += share[j];
    const auto block = proposals.draw(1, at + 0.5 * share[i]);
    EXPECT_EQ(block.row * LobeProposals::kColumns + block.column, i);
    EXPECT_NEAR(block.weight / proposals.total(1), share[i], 2.0 / kSteps) << i;
  }
}

TEST(LobeProposals, TheEndsOfTheUnitInterval) {
  LobeProposals proposals;
  proposals.add(uneven_weights());
  const auto first = proposals.draw(0, 0.0);
  EXPECT_EQ(first.row * LobeProposals::kColumns + first.column, 1u);
  const auto last = proposals.draw(0, 1.0 - 0x1.0p-53);
  EXPECT_EQ(last.row * LobeProposals::kColumns + last.column, LobeProposals::kBlocks - 2);
}

TEST(LobeProposals, RefusesAWrongNumberOfWeights) {
  LobeProposals proposals;
  EXPECT_THROW(proposals.add(std::vector<double>(7, 1.0)), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/sampled_mueller_builder.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/mueller_films.h"

namespace evenglow::tracer {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A film whose reflection falls off with theta and whose transmission is flat, up to 30 degrees of incidence.
MuellerTable lobes(double power) {
  return MuellerTable(tests::mueller_stored("lobes.csv", {0, 1},
                                            {{{0, 90}, {0, 30}, {0, 90, 180, 270}, {0, 20, 40, 70}, {550}}},
                                            [=](const tests::NodeIndex& i) -> core::MuellerMatrix {
                                              constexpr double kFall[] = {1.0, 0.5, 0.1, 0.01};
                                              const double value = i[0] == 0 ? power * kFall[i[4]] : 0.1 * power;
                                              return value * core::diattenuator(1.0, 0.2);
                                            }));
}

double total(const ResampledMuellerNode& node, std::size_t kind) {
  double sum = 0.0;
  for (std::size_t i = 0; i < node.weights.size(); ++i) sum += node.weights[i] * node.kinds[kind][i](0, 0);
  return sum;
}

TEST(MuellerResampler, AFlatKindIsLambertian) {
  const MuellerTable table = lobes(0.3);
  MuellerResampler resampler(table, 550.0, nullptr, 1.58, 16, 20);
  const ResampledMuellerNode node = resampler.node(0.0, 0.0);
  // pi times the value: 0.03 times the mean 0.6 of the diattenuator.
  EXPECT_NEAR(total(node, 1), core::kPi * 0.03 * 0.6, 1e-6);
}

TEST(MuellerResampler, TotalsAreHeldBeyondTheData) {
  const MuellerTable table = lobes(0.3);
  MuellerResampler resampler(table, 550.0, nullptr, 1.58, 16, 20);
  const ResampledMuellerNode edge = resampler.node(0.5, 30.0 * core::kRadPerDeg);
  for (const double sigma : {40.0, 70.0, 85.0}) {
    const ResampledMuellerNode node = resampler.node(0.5, sigma * core::kRadPerDeg);
    for (const std::size_t kind : {0u, 1u}) EXPECT_NEAR(total(node, kind) / total(edge, kind), 1.0, 1e-9) << sigma;
  }
  EXPECT_THAT(resampler.remarks(), ElementsAre(HasSubstr("no data beyond sigma = 30 degrees")));
}

TEST(MuellerResampler, WhatWouldGiveEnergyIsScaledDown) {
  const MuellerTable table = lobes(3.0);
  MuellerResampler resampler(table, 550.0, nullptr, 1.58, 16, 20);
  const ResampledMuellerNode node = resampler.node(0.0, 0.0);
  // The stronger polarization, 1 / 0.6 of the mean, gets just what it brings.
  EXPECT_NEAR((total(node, 0) + total(node, 1)) / 0.6, 1.0, 1e-6);
  EXPECT_THAT(resampler.remarks().back(), HasSubstr("R + T above 1 at 1 of 1 incidences"));
}

}  // namespace
}  // namespace evenglow::tracer

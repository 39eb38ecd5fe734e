#include "design/engine/four_stream.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

StreamPlate plate_with(const std::vector<std::size_t>& lit, int nx = 48, int ny = 24) {
  StreamPlate plate;
  plate.cells = core::CellGrid::over(nx, ny, 0, 0, 140, 66);
  plate.rate.assign(static_cast<std::size_t>(nx), 0.225 / 0.6);
  for (auto& edge : plate.edges) edge.reflectance = 0.9;
  for (const std::size_t side : lit) {
    auto& inflow = plate.edges[side].inflow;
    inflow.assign(static_cast<std::size_t>(side < 2 ? ny : nx), 0.0);
    for (std::size_t i = 0; i < inflow.size(); ++i) inflow[i] = i % 2 == 0 ? 1.0 : 0.3;  // LEDs and gaps
  }
  return plate;
}

double rms_of(const core::CellField& light, const core::CellField& target) {
  double mean = 0.0, squares = 0.0;
  const double n = static_cast<double>(light.values.size());
  for (std::size_t i = 0; i < light.values.size(); ++i) mean += light.values[i] / target.values[i] / n;
  for (std::size_t i = 0; i < light.values.size(); ++i)
    squares += std::pow(light.values[i] / target.values[i] / mean - 1.0, 2) / n;
  return std::sqrt(squares);
}

TEST(FourStream, DensityMakesTheLightEvenWithLedsAtAnyEdges) {
  for (const std::vector<std::size_t>& lit : {std::vector<std::size_t>{0}, {0, 1}, {2}, {2, 3}, {0, 2}, {0, 1, 2, 3}}) {
    const StreamPlate plate = plate_with(lit);
    const core::CellField even(plate.cells, 1.0);
    const core::CellField flat(plate.cells, 0.05);
    ASSERT_GT(rms_of(stream_light(plate, flat), even), 0.05) << lit.size();
    const core::CellField density = stream_density(plate, even, 0.05, 1e-4, 0.9);
    EXPECT_NEAR(density.mean(), 0.05, 1e-6);
    EXPECT_LT(rms_of(stream_light(plate, density), even), 0.01) << lit.size();
  }
}

TEST(FourStream, MeetsATarget) {
  const StreamPlate plate = plate_with({0});
  core::CellField target(plate.cells, 1.0);
  for (std::size_t i = 0; i < target.values.size(); ++i) target.values[i] = 1.0 + 0.3 * std::sin(0.1 * i);
  const core::CellField density = stream_density(plate, target, 0.05, 1e-4, 0.9);
  EXPECT_LT(rms_of(stream_light(plate, density), target), 0.01);
}

TEST(FourStream, OneStreamDecaysAsItsClosedForm) {
  // All that meets the pattern leaves: along x the light of a flat density falls by exp(-rate density h) from cell to
  // cell, and all that is not let out leaves by the far edge.
  StreamPlate plate = plate_with({0}, 20, 1);
  plate.out = 1.0;
  for (auto& edge : plate.edges) edge.reflectance = 0.0;
  const core::CellField light = stream_light(plate, core::CellField(plate.cells, 0.08), 3);
  const double factor = std::exp(-0.225 / 0.6 * 0.08 * 7.0);
  EXPECT_NEAR(light.values[0], 1.0 - factor, 1e-12);
  for (std::size_t i = 1; i < 20; ++i) EXPECT_NEAR(light.values[i] / light.values[i - 1], factor, 1e-12);
}

TEST(FourStream, DensityRisesAwayFromTheLeds) {
  const StreamPlate plate = plate_with({0});
  const core::CellField density = stream_density(plate, core::CellField(plate.cells, 1.0), 0.05, 1e-4, 0.9);
  for (int ix = 4; ix < 40; ++ix) {
    const auto i = static_cast<std::size_t>(12 * 48 + ix);
    EXPECT_GT(density.values[i + 1], density.values[i]);
  }
}

}  // namespace
}  // namespace evenglow::design

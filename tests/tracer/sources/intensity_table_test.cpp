#include "tracer/sources/intensity_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tests {
namespace {

using namespace tracer;
using core::kPi;

constexpr double kDeg = core::kRadPerDeg;

TEST(IntensityTable, FluxInClosedForm) {
  const IntensityTable even = whole_circle({0.0, kPi}, {0.0}, {2.0, 2.0}, AzimuthSymmetry::kRotation);
  EXPECT_NEAR(total_flux(even), 8.0 * kPi, 1e-12);
  // I = theta: 2 pi (sin t - t cos t) from 0 to pi/2.
  const IntensityTable rising =
      whole_circle({0.0, 0.3, 0.5 * kPi}, {0.0}, {0.0, 0.3, 0.5 * kPi}, AzimuthSymmetry::kRotation);
  EXPECT_NEAR(total_flux(rising), 2.0 * kPi, 1e-12);
}

TEST(IntensityTable, IsBilinearAndZeroBeyondItsAngles) {
  const IntensityTable table = whole_circle({0.1, 1.0}, {0.0, 2.0 * kPi}, {1, 2, 3, 6}, AzimuthSymmetry::kNone);
  EXPECT_DOUBLE_EQ(table.intensity(0.55, kPi), 3.0);
  EXPECT_EQ(table.intensity(0.05, 1.0), 0.0);
  EXPECT_EQ(table.intensity(1.05, 1.0), 0.0);
}

TEST(IntensityTable, SymmetriesFillTheCircle) {
  const auto build = [](std::vector<double> phi_deg, AzimuthSymmetry symmetry) {
    std::vector<double> values;
    for (double& phi : phi_deg) {
      values.insert(values.end(), {phi, phi});
      phi *= kDeg;
    }
    return whole_circle({0.0, 1.0}, phi_deg, values, symmetry);
  };
  const auto at = [](const IntensityTable& table, double phi_deg) { return table.intensity(0.5, phi_deg * kDeg); };
  const IntensityTable quadrant = build({0, 30, 90}, AzimuthSymmetry::kQuadrant0To90);
  for (const double phi : {30.0, 150.0, 210.0, 330.0}) EXPECT_NEAR(at(quadrant, phi), 30.0, 1e-9) << phi;
  EXPECT_NEAR(at(quadrant, 180), 0.0, 1e-9);
  EXPECT_NEAR(at(quadrant, 270), 90.0, 1e-9);
  const IntensityTable half = build({0, 30, 180}, AzimuthSymmetry::kPlane0To180);
  EXPECT_NEAR(at(half, 330), 30.0, 1e-9);
  EXPECT_NEAR(at(half, 105), 105.0, 1e-9);
  EXPECT_NEAR(at(half, 255), 105.0, 1e-9);
  // No node at 0 nor 180: the seam lies between 120 and its mirror image 60.
  const IntensityTable across = build({90, 120, 270}, AzimuthSymmetry::kPlane90To270);
  EXPECT_NEAR(at(across, 60), 120.0, 1e-9);
  EXPECT_NEAR(at(across, 195), 195.0, 1e-9);
  EXPECT_NEAR(at(across, 345), 195.0, 1e-9);
  EXPECT_NEAR(at(across, 0), at(across, 360), 1e-9);
  EXPECT_NEAR(at(across, 0), 180.0, 1e-9);
  for (const IntensityTable* table : {&quadrant, &half, &across}) {
    EXPECT_EQ(table->phi.front(), 0.0);
    EXPECT_EQ(table->phi.back(), 2.0 * kPi);
    for (std::size_t i = 1; i < table->phi.size(); ++i) EXPECT_LT(table->phi[i - 1], table->phi[i]);
    EXPECT_EQ(table->values.size(), table->phi.size() * 2);
  }
}

TEST(IntensityTable, RangesTellTheSymmetry) {
  EXPECT_EQ(symmetry_of_range(0, 0), AzimuthSymmetry::kRotation);
  EXPECT_EQ(symmetry_of_range(0, 90), AzimuthSymmetry::kQuadrant0To90);
  EXPECT_EQ(symmetry_of_range(0, 180), AzimuthSymmetry::kPlane0To180);
  EXPECT_EQ(symmetry_of_range(0, 360), AzimuthSymmetry::kNone);
  EXPECT_EQ(symmetry_of_range(90, 270), AzimuthSymmetry::kPlane90To270);
  EXPECT_THROW(symmetry_of_range(0, 345), core::Error);
}

TEST(IntensityTable, TheFrontEndsAt90Degrees) {
  const IntensityTable sphere = whole_circle({0.0, 2.0, kPi}, {0.0}, {1, 1, 1}, AzimuthSymmetry::kRotation);
  const IntensityTable front = front_hemisphere(sphere);
  EXPECT_EQ(front.theta.back(), 0.5 * kPi);
  EXPECT_NEAR(total_flux(front), 2.0 * kPi, 1e-12);
  const IntensityTable behind = whole_circle({0.5 * kPi, kPi}, {0.0}, {1, 1}, AzimuthSymmetry::kRotation);
  EXPECT_TRUE(front_hemisphere(behind).theta.empty());
}

}  // namespace
}  // namespace evenglow::tests

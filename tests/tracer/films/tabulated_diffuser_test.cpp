#include "tracer/films/tabulated_diffuser.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tracer/films/scatter_table.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;
using tests::travel;

/// Gaussian lobes about the unscattered ray, 12 degrees to 1 / sqrt e, at 0, 30 and 60 degrees.
std::string lobes(double btdf, double brdf) {
  std::string text = "incidence_deg,theta_deg,btdf,brdf\n";
  for (const double sigma : {0, 30, 60}) {
    for (int theta = 0; theta <= 80; theta += 2) {
      const double lobe = std::exp(-0.5 * std::pow(theta / 12.0, 2));
      text += fmt::format("{},{},{},{}\n", sigma, theta, btdf * lobe, brdf * lobe);
    }
  }
  return text;
}

core::StokesVector natural(const core::Vec3& k) {
  return core::StokesVector::unpolarized(1.0, tangential_frame(k).frame);
}

TEST(TabulatedDiffuser, ReadsTheTableAtItsNodes) {
  const BsdfTable table = parse_scatter_table(lobes(2.0, 0.3), "t.csv");
  const TabulatedDiffuser film(table, std::nullopt, 0.0);
  EXPECT_THAT(film.remarks(), ::testing::ElementsAre(HasSubstr("no data beyond sigma = 60 degrees")));
  // theta 12 degrees from the straight and from the mirrored ray at normal incidence, either side, any azimuth.
  for (const double azimuth : {0.0, 50.0, 200.0}) {
    EXPECT_NEAR(film.evaluate(natural(travel(0, 0)), travel(12, azimuth)).I, 2.0 * std::exp(-0.5), 0.02);
    EXPECT_NEAR(film.evaluate(natural(travel(0, 0, true)), travel(12, azimuth)).I, 0.3 * std::exp(-0.5), 0.003);
  }
  // The lobe goes with the ray.
  EXPECT_NEAR(film.evaluate(natural(travel(60, 77)), travel(60, 77)).I, 2.0, 0.05);
  EXPECT_NEAR(film.evaluate(natural(travel(45, 77)), travel(45, 77, true)).I, 0.3, 0.01);
}

TEST(TabulatedDiffuser, TotalsAreItsOwnOrThoseAsked) {
  const BsdfTable table = parse_scatter_table(lobes(2.0, 0.3), "t.csv");
  const TabulatedDiffuser own(table, std::nullopt, 0.0);
  // integral of 2 pi exp(-theta^2 / 2 a^2) sin theta cos theta
  double expected = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double theta = 0.5 * M_PI * (i + 0.5) / 2000;
    const double lobe = std::exp(-0.5 * std::pow(theta / (12.0 * core::kRadPerDeg), 2));
    expected += 2.0 * M_PI * 2.0 * lobe * std::sin(theta) * std::cos(theta) * 0.5 * M_PI / 2000;
  }
  EXPECT_NEAR(own.hemispherical(travel(0, 0), ScatterKind::transmission), expected, 0.01 * expected);
  EXPECT_NEAR(own.hemispherical(travel(0, 0), ScatterKind::reflection), 0.15 * expected, 0.0015 * expected);
  const TabulatedDiffuser asked(table, TabulatedDiffuser::Totals{0.8, 0.15}, 0.0);
  for (const double sigma : {0.0, 20.0, 50.0, 80.0}) {
    EXPECT_NEAR(asked.hemispherical(travel(sigma, 33), ScatterKind::transmission), 0.8, 1e-3) << sigma;
    EXPECT_NEAR(asked.hemispherical(travel(sigma, 33), ScatterKind::reflection), 0.15, 1e-3) << sigma;
  }
  EXPECT_THAT(asked.remarks(), ::testing::ElementsAre(HasSubstr("transmittance and reflectance"),
                                                      HasSubstr("no data beyond sigma = 60 degrees")));
}

TEST(TabulatedDiffuser, NeverGivesMoreThanItGets) {
  const TabulatedDiffuser film(parse_scatter_table(lobes(10.0, 1.0), "t.csv"), std::nullopt, 0.0);
  EXPECT_THAT(film.remarks(), ::testing::Contains(HasSubstr("R + T above 1")));
  for (const double sigma : {0.0, 45.0, 85.0}) {
    const core::Vec3 k = travel(sigma, 10);
    EXPECT_LE(film.hemispherical(k, ScatterKind::transmission) + film.hemispherical(k, ScatterKind::reflection),
              1.0 + 1e-9);
  }
}

TEST(TabulatedDiffuser, PolarizationIsThatOfADiffuser) {
  const TabulatedDiffuser film(parse_scatter_table(lobes(2.0, 0.3), "t.csv"), std::nullopt, 0.25);
  const auto light = core::StokesVector::linear(1.0, 0.0, {travel(0, 0), core::Vec3::UnitX()});
  for (const double azimuth : {0.0, 90.0, 200.0}) {
    for (const bool up : {false, true}) {
      const auto out = film.evaluate(light, travel(1.0, azimuth, up));
      const core::Vec3 e1 = (core::Vec3::UnitX() - out.frame.k * out.frame.k.x()).normalized();
      EXPECT_NEAR(out.in_frame(e1).Q / out.I, 0.75, 1e-3);
      EXPECT_NEAR(film.evaluate(natural(travel(0, 0)), travel(1.0, azimuth, up)).I, out.I, 1e-12);
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/bracket.h"

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

constexpr double kDeg = core::kRadPerDeg;

TEST(Bracket, FindsTheIntervalAndHoldsTheEnds) {
  const std::vector<double> nodes{400, 500, 700};
  for (const auto& [x, i, j, t] : {std::tuple{300.0, 0, 0, 0.0},
                                   {400.0, 0, 0, 0.0},
                                   {450.0, 0, 1, 0.5},
                                   {500.0, 1, 2, 0.0},
                                   {550.0, 1, 2, 0.25},
                                   {700.0, 2, 2, 0.0},
                                   {900.0, 2, 2, 0.0}}) {
    const Bracket b = lambda_bracket(nodes, x);
    EXPECT_EQ(b.i, static_cast<std::size_t>(i)) << x;
    EXPECT_EQ(b.j, static_cast<std::size_t>(j)) << x;
    EXPECT_NEAR(b.t, t, 1e-15) << x;
  }
}

TEST(Bracket, OneNodeServesAll) {
  for (const double x : {-1.0, 0.0, 5.0}) {
    const Bracket b = lambda_bracket({1.0}, x);
    EXPECT_EQ(b.i + b.j, 0u);
    EXPECT_EQ(b.t, 0.0);
  }
}

TEST(Bracket, SigmaIsLinearInTheSquareOfItsSine) {
  const Bracket b = sigma_bracket({0.0, 60 * kDeg}, 30 * kDeg);
  EXPECT_NEAR(b.t, 0.25 / 0.75, 1e-12);
}

TEST(Bracket, ThetaIsQuadraticUpToTenDegrees) {
  const std::vector<double> nodes{0.0, 10 * kDeg, 20 * kDeg};
  EXPECT_NEAR(theta_bracket(nodes, 5 * kDeg).t, 0.25, 1e-12);
  EXPECT_NEAR(theta_bracket(nodes, 15 * kDeg).t, 0.5, 1e-12);
}

}  // namespace
}  // namespace evenglow::tracer

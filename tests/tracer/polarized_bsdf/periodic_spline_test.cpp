#include "tracer/polarized_bsdf/periodic_spline.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

double value(const PeriodicSpline& spline, const std::vector<double>& y, double x) {
  double sum = 0.0;
  const std::vector<double> w = spline.weights(x);
  for (std::size_t i = 0; i < y.size(); ++i) sum += w[i] * y[i];
  return sum;
}

TEST(PeriodicSpline, FollowsASmoothCurveOnUnevenNodes) {
  std::vector<double> nodes, y;
  for (int i = 0; i < 24; ++i) nodes.push_back((i + 0.3 * std::sin(i)) * 2.0 * M_PI / 24.0);
  for (const double x : nodes) y.push_back(std::sin(x) + 0.5 * std::cos(2.0 * x));
  const PeriodicSpline spline(nodes, 2.0 * M_PI);
  for (double x = -7.0; x < 7.0; x += 0.01) {
    EXPECT_NEAR(value(spline, y, x), std::sin(x) + 0.5 * std::cos(2.0 * x), 2e-3);
  }
}

TEST(PeriodicSpline, HasNoStepInItsSlopeAtTheSeam) {
  const PeriodicSpline spline({0.0, 1.0, 2.0, 3.0}, 4.0);
  const std::vector<double> y{1.0, 3.0, -2.0, 0.5};
  const double h = 1e-5;
  const double before = (value(spline, y, 4.0) - value(spline, y, 4.0 - h)) / h;
  const double after = (value(spline, y, h) - value(spline, y, 0.0)) / h;
  EXPECT_NEAR(before, after, 1e-3);
}

TEST(PeriodicSpline, PlaceAndWeightsAgree) {
  const PeriodicSpline spline({0.2, 1.0, 2.5}, 4.0);
  const std::vector<double> y{1.0, 3.0, -2.0};
  const std::vector<double> m = spline.second_derivatives(y);
  for (double x = -1.0; x < 6.0; x += 0.37) {
    const PeriodicSpline::Place p = spline.place(x);
    EXPECT_NEAR(p.a * y[p.i] + p.b * y[p.j] + p.c * m[p.i] + p.d * m[p.j], value(spline, y, x), 1e-12);
  }
}

TEST(PeriodicSpline, OneAndTwoNodes) {
  EXPECT_EQ(value(PeriodicSpline({0.0}, 1.0), {5.0}, 0.7), 5.0);
  EXPECT_NEAR(value(PeriodicSpline({0.0, 0.5}, 1.0), {1.0, 3.0}, 0.25), 2.0, 1e-12);
}

}  // namespace
}  // namespace evenglow::tracer

#include "tracer/goniometer/goniometer_optics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kRad = core::kRadPerDeg;

GoniometerSpec spec_at(double sigma_deg) {
  GoniometerSpec spec;
  spec.sigma = sigma_deg * kRad;
  spec.filter.k1 = 0.8;
  spec.filter.k2 = 0.2;
  return spec;
}

TEST(GoniometerOptics, TheAxesAreMirroredAndStraight) {
  const GoniometerSpec spec = spec_at(30.0);
  const GoniometerView view(spec, 0.0);
  const core::Vec3 in = view.light(ScatterKind::reflection, false, 0.0).frame.k;
  const core::Vec3 straight = view.direction(ScatterKind::transmission, 0.0, 0.0);
  const core::Vec3 mirrored = view.direction(ScatterKind::reflection, 0.0, 0.0);
  EXPECT_LT(in.z(), 0.0);  // from above
  EXPECT_NEAR(std::acos(-in.z()) / kRad, 30.0, 1e-9);
  EXPECT_NEAR((straight - in).norm(), 0.0, 1e-12);
  EXPECT_NEAR((mirrored - core::Vec3(in.x(), in.y(), -in.z())).norm(), 0.0, 1e-12);
}

TEST(GoniometerOptics, ThetaIsTheAngleFromTheAxis) {
  const GoniometerSpec spec = spec_at(40.0);
  const GoniometerView view(spec, 25.0 * kRad);
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const core::Vec3 axis = view.direction(kind, 0.0, 0.0);
    for (const double phi : {0.0, 1.0, 4.0}) {
      EXPECT_NEAR(std::acos(view.direction(kind, phi, 15.0 * kRad).dot(axis)) / kRad, 15.0, 1e-9);
    }
  }
}

TEST(GoniometerOptics, TheFilterLeavesItsDegreeOfPolarization) {
  const GoniometerSpec spec = spec_at(0.0);
  const GoniometerView view(spec, 0.0);
  EXPECT_TRUE(view.light(ScatterKind::reflection, false, 0.0).is_unpolarized());
  const core::StokesVector light = view.light(ScatterKind::reflection, true, 0.7);
  EXPECT_NEAR(light.degree_of_polarization(), 0.6, 1e-12);  // (k1 - k2) / (k1 + k2)
  EXPECT_NEAR(light.I, 1.0, 1e-12);
}

TEST(GoniometerOptics, ConePointsFillTheConeEvenly) {
  const double half = 2.0 * kRad, theta = 20.0 * kRad;
  const auto points = cone_points(theta, half);
  const core::Vec3 axis(std::sin(theta), 0.0, std::cos(theta));
  core::Vec3 mean = core::Vec3::Zero();
  for (const ConePoint& p : points) {
    const core::Vec3 d(std::sin(p.theta) * std::cos(p.phi), std::sin(p.theta) * std::sin(p.phi), std::cos(p.theta));
    EXPECT_LE(std::acos(d.dot(axis)), half + 1e-9);
    mean += d / static_cast<double>(points.size());
  }
  // The mean direction of a cone lies on its axis, (1 + cos half) / 2 long.
  EXPECT_NEAR((mean - 0.5 * (1.0 + std::cos(half)) * axis).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace evenglow::tracer

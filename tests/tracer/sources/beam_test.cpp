#include "tracer/sources/beam.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/scenes.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

Photon one_photon(const std::string& keys, const std::string& size = "size: {length_mm: 20, width_mm: 10}") {
  const BacklightSpec spec = backlight_of(size + ", sources: [{kind: beam, " + keys + "}]");
  core::PhotonRng rng({1, 0, 0}, 0);
  return spec.sources.front()->emit(rng);
}

TEST(Beam, DirectionFollowsAngleAndPlane) {
  const double c = std::cos(30.0 * core::kRadPerDeg), s = std::sin(30.0 * core::kRadPerDeg);
  EXPECT_NEAR((one_photon("face: bottom").light.frame.k - core::Vec3(0, 0, 1)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((one_photon("face: bottom, angle_deg: 30").light.frame.k - core::Vec3(s, 0, c)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((one_photon("face: bottom, angle_deg: 30, plane_deg: 90").light.frame.k - core::Vec3(0, s, c)).norm(),
              0.0, 1e-15);
  EXPECT_NEAR((one_photon("face: top, angle_deg: 30").light.frame.k - core::Vec3(s, 0, -c)).norm(), 0.0, 1e-15);
  const std::string plate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}";
  EXPECT_NEAR((one_photon("face: left, angle_deg: 30", plate).light.frame.k - core::Vec3(c, s, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(
      (one_photon("face: right, angle_deg: 30, plane_deg: 90", plate).light.frame.k - core::Vec3(-c, 0, s)).norm(), 0.0,
      1e-15);
}

/// 0 is p, 90 is s, and every frame is right-handed; from every face, obliquely.
TEST(Beam, Polarization) {
  const std::string plate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}";
  for (const char* face : {"left", "right", "front", "back", "bottom", "top"}) {
    const std::string keys = std::string("face: ") + face + ", angle_deg: 40, plane_deg: 20, ";
    const auto p = one_photon(keys + "polarization: linear, azimuth_deg: 0", plate).light;
    const auto s = one_photon(keys + "polarization: linear, azimuth_deg: 90", plate).light;
    const core::Vec3 normal = [&] {
      for (int i = 0; i < kSides; ++i) {
        if (std::string(side_name(static_cast<Side>(i))) == face) return outward(static_cast<Side>(i));
      }
      return core::Vec3(core::Vec3::Zero());
    }();
    const core::Vec3 s_axis = p.frame.k.cross(normal).normalized();
    EXPECT_NEAR(p.frame.e1.dot(p.frame.k), 0.0, 1e-15);
    EXPECT_NEAR(p.frame.e1.norm(), 1.0, 1e-15);
    EXPECT_NEAR(p.in_frame(s_axis).Q, -1.0, 1e-14) << face;
    EXPECT_NEAR(s.in_frame(s_axis).Q, 1.0, 1e-14) << face;
    EXPECT_EQ(one_photon(keys + "polarization: circular", plate).light.V, 1.0);
    EXPECT_TRUE(one_photon(keys + "polarization: none", plate).light.is_unpolarized());
  }
}

/// 45 degrees from below: the field lies between +p and the axis z x h, so that a film turned by +45 from the plane of
/// incidence passes it at normal incidence.
TEST(Beam, AzimuthTurnsTheSameWayAsFilmAxes) {
  const auto light = one_photon("face: bottom, polarization: linear, azimuth_deg: 45").light;
  const double h = std::sqrt(0.5);
  EXPECT_NEAR(light.in_frame({h, h, 0.0}).Q, 1.0, 1e-14);
}

TEST(Beam, LitSpot) {
  const BacklightSpec spec = backlight_of(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: beam, size_share: 0.5, gap_mm: 2, flux_lm: 3}]");
  core::PhotonRng rng({1, 0, 0}, 0);
  double x0 = 99, x1 = 0, y0 = 99, y1 = 0;
  for (int i = 0; i < 5000; ++i) {
    const core::Vec3 p = spec.sources.front()->emit(rng).position;
    EXPECT_DOUBLE_EQ(p.z(), -2.0);
    x0 = std::min(x0, p.x());
    x1 = std::max(x1, p.x());
    y0 = std::min(y0, p.y());
    y1 = std::max(y1, p.y());
  }
  EXPECT_NEAR(x0, 5.0, 0.05);
  EXPECT_NEAR(x1, 15.0, 0.05);
  EXPECT_NEAR(y0, 2.5, 0.05);
  EXPECT_NEAR(y1, 7.5, 0.05);
  EXPECT_EQ(spec.sources.front()->flux(), 3.0);
}

TEST(Beam, RefusesGrazingAngles) {
  EXPECT_THROW(one_photon("face: bottom, angle_deg: 90"), core::ConfigError);
  EXPECT_THROW(one_photon("face: bottom, polarization: elliptic"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests

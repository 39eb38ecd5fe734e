#include "tracer/scene/plate_keys.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"
#include "tracer/transport/photon_history.h"

/// Wedges and serrated end faces. Limits are 4.5 standard errors: false alarm 7e-6 a comparison; seeds fixed.
namespace evenglow::tracer {
namespace {

using tests::scene_of;
using tests::Traced;

const std::string kLit = ", sources: [{kind: lambertian_face, face: left}]";

std::string fault_of(const std::string& yaml) {
  try {
    scene_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Wedge, OfEqualEndsIsAPlate) {
  const std::string size = "light_guide_plate: {length_mm: 40, width_mm: 10, thickness_mm: 2";
  const Traced plate(size + "}" + kLit, {20'000});
  const Traced wedge(size + ", end_thickness_mm: 2}" + kLit, {20'000});
  for (std::size_t bin = 0; bin < plate.result().energy.bins(); ++bin) {
    EXPECT_EQ(plate.result().energy.total(bin).value, wedge.result().energy.total(bin).value);
  }
}

TEST(Wedge, LosesNothing) {
  const Traced furnace(
      "light_guide_plate: {length_mm: 40, width_mm: 10, thickness_mm: 4, end_thickness_mm: 0.5, refractive_index: "
      "1.49}" +
          kLit +
          ", reflectors: {left: {kind: mirror, reflectance: 1, gap_mm: 0.5}, right: {kind: white, reflectance: 1, "
          "gap_mm: 0.5}, front: {kind: mirror, reflectance: 1, gap_mm: 0.5}, back: {kind: white, reflectance: 1, "
          "gap_mm: 0.5}, bottom: {kind: white, reflectance: 1, gap_mm: 0.5}}",
      {20'000});
  EXPECT_EQ(furnace.escaped(Side::kTop), furnace.photons());
  EXPECT_EQ(furnace.lost(), 0.0);
}

TEST(Wedge, TheThinEndIsNotBrighterThanTheSource) {
  // No radiance above the source's: the thin end, a tenth of the thick one, lets out a tenth of the light at most. A
  // flat plate lets out 85 %. What turns too steep leaves by the top and the bottom.
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 100, width_mm: 2000, thickness_mm: 10, end_thickness_mm: 1, refractive_index: "
      "1.4938}" +
      kLit);
  const DensityField density = initial_density(scene.spec);
  const PhotonHistory history(scene, density);
  constexpr int kPhotons = 40'000;
  double by_the_end = 0.0;
  for (std::uint64_t i = 0; i < kPhotons; ++i) {
    core::PhotonRng rng({8, 0, 0}, i);
    BatchSums sums(scene);
    auto walk = history.start(rng);
    while (history.step(walk, rng, sums)) {
    }
    if (walk.photon.quad == static_cast<int>(Side::kRight)) by_the_end += 1.0 / kPhotons;
  }
  EXPECT_LT(by_the_end, 0.1 + 4.5 * std::sqrt(0.09 / kPhotons));
  EXPECT_GT(by_the_end, 0.05);
}

TEST(Wedge, LightBelowItPassesItsWall) {
  // A ray along y, 90 mm from the thick end: at z = 1 below the bottom (8.1 mm there), at z = 9 into the plate.
  const Scene scene =
      scene_of("light_guide_plate: {length_mm: 100, width_mm: 20, thickness_mm: 10, end_thickness_mm: 1}" + kLit +
               ", reflectors: {front: {kind: white, reflectance: 0, gap_mm: 1}, back: {kind: white, reflectance: 0, "
               "gap_mm: 1}}");
  const DensityField density = initial_density(scene.spec);
  const PhotonHistory history(scene, density);
  for (const auto& [z, enters] : {std::pair{1.0, false}, {9.0, true}}) {
    BatchSums sums(scene);
    core::PhotonRng rng({5, 0, 0}, 0);
    PhotonHistory::Walk walk;
    walk.optical_depth = 10.0;
    walk.photon.position = {90.0, -0.5, z};
    walk.photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(core::Vec3::UnitY()));
    const bool goes_on = history.step(walk, rng, sums);
    EXPECT_EQ(goes_on, enters);  // the black wall behind takes what passes
    if (enters) {
      EXPECT_NEAR(walk.photon.position.y(), 0.0, 1e-12);
    }
  }
}

TEST(Wedge, WrongOnesAreRefused) {
  EXPECT_THAT(fault_of("light_guide_plate: {thickness_mm: 1, end_thickness_mm: 2}" + kLit),
              ::testing::HasSubstr("end_thickness_mm: must be at most thickness_mm = 1 mm, got 2 mm"));
  EXPECT_THAT(fault_of("light_guide_plate: {thickness_mm: 1, end_thickness_mm: 0.5}, sources: [{kind: lambertian_face, "
                       "face: right}]"),
              ::testing::HasSubstr("a wedge is lit at its thick end"));
}

/// Share of the photons that, just inside, run farther from the x axis towards +-y than refraction at a flat face lets
/// them; and the share that got in.
std::pair<double, double> spread(const std::string& entrance) {
  const Scene scene =
      scene_of("light_guide_plate: {length_mm: 40, width_mm: 20, thickness_mm: 2, refractive_index: 1.5" + entrance +
               "}" + kLit);
  const DensityField density = initial_density(scene.spec);
  const PhotonHistory history(scene, density);
  double wide = 0.0, in = 0.0;
  constexpr int kPhotons = 40'000;
  for (std::uint64_t i = 0; i < kPhotons; ++i) {
    core::PhotonRng rng({6, 0, 0}, i);
    BatchSums sums(scene);
    auto walk = history.start(rng);
    if (!history.step(walk, rng, sums) || walk.photon.body < 0) continue;
    in += 1.0 / kPhotons;
    if (std::abs(walk.photon.light.frame.k.y()) > 1.0 / 1.5 + 1e-9) wide += 1.0 / kPhotons;
  }
  return {wide, in};
}

TEST(Entrance, SerrationsSpreadTheLightInThePlane) {
  const auto [flat_wide, flat_in] = spread("");
  EXPECT_EQ(flat_wide, 0.0);
  EXPECT_NEAR(flat_in, 0.908, 0.006);  // hemispherical transmittance of n = 1.5: 1 - 0.0918 (Walsh; Duntley 1942)
  for (const char* form : {"sunk", "raised"}) {
    const auto [wide, in] = spread(std::string(", entrance: {flank_deg: 35, form: ") + form + "}");
    EXPECT_GT(wide, 0.05) << form;
    EXPECT_GT(in, 0.7) << form;
  }
  const auto [hardly_wide, hardly_in] = spread(", entrance: {flank_deg: 0.1}");
  EXPECT_LT(hardly_wide, 0.002);
  EXPECT_NEAR(hardly_in, flat_in, 4.5 * std::sqrt(2.0 * 0.09 / 40'000));
}

TEST(Entrance, SerrationsRunThroughTheThickness) {
  // Light in the plane of x and z meets ridges along z lengthwise: flanks turn it aside, never up or down by more than
  // a flat face would. Seen by kz of light that comes nearly level.
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 40, width_mm: 20, thickness_mm: 2, refractive_index: 1.5, "
      "entrance: {flank_deg: 40}}" +
      kLit);
  const Surface& face = scene.optics[0].surfaces[static_cast<std::size_t>(Side::kLeft)];
  core::PhotonRng rng({7, 0, 0}, 0);
  for (int i = 0; i < 1000; ++i) {
    const core::Vec3 k = core::Vec3(0.98, 0.0, 0.1).normalized();
    const core::Vec3 local(face.x.dot(k), face.y.dot(k), face.normal.dot(k));
    const auto out =
        face.optics->sample(core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(local)), rng);
    ASSERT_TRUE(out);
    const core::Vec3& o = out->light.frame.k;
    const double kz = (o.x() * face.x + o.y() * face.y + o.z() * face.normal).z();
    const bool inside = o.z() < 0.0;
    EXPECT_NEAR(kz, k.z() / (inside ? 1.5 : 1.0), 1e-12);  // invariant along the ridges
  }
}

}  // namespace
}  // namespace evenglow::tracer

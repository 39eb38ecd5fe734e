#include "tracer/sources/lambertian_face.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

TEST(LambertianFace, CoversEachFaceEvenlyAndLambertian) {
  const char* faces[] = {"left", "right", "front", "back", "bottom", "top"};
  const double chance = sidak(1e-3, 12);
  for (int f = 0; f < kSides; ++f) {
    const auto side = static_cast<Side>(f);
    const BacklightSpec spec = backlight_of(
        "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}, sources: [{kind: lambertian_face, face: " +
        std::string(faces[f]) + ", gap_mm: 0.5, flux_lm: 7}]");
    const Source& source = *spec.sources.front();
    EXPECT_EQ(source.flux(), 7.0);
    EXPECT_EQ(source.side(), side);
    EXPECT_EQ(source.window_surface(), nullptr);
    const int axis = axis_of(side), a = (axis + 1) % 3, b = (axis + 2) % 3;
    std::vector<double> places(36, 0.0), angles(20, 0.0);
    constexpr int kPhotons = 20000;
    core::PhotonRng rng({20260101, static_cast<std::uint32_t>(f), 0}, 0);
    for (int i = 0; i < kPhotons; ++i) {
      const Photon photon = source.emit(rng);
      ASSERT_DOUBLE_EQ(photon.position[axis], spec.area.plane(side) + 0.5 * outward(side)[axis]);
      ASSERT_TRUE(photon.light.is_unpolarized());
      ASSERT_EQ(photon.light.I, 1.0);
      const double cosine = -outward(side).dot(photon.light.frame.k);
      ASSERT_GT(cosine, 0.0);
      const auto cell = [&](int i2) {
        return std::min(5, static_cast<int>(6.0 * photon.position[i2] / spec.area.max[i2]));
      };
      places[static_cast<std::size_t>(6 * cell(a) + cell(b))] += 1.0;
      angles[static_cast<std::size_t>(std::min(19.0, 20.0 * (1.0 - cosine * cosine)))] += 1.0;
    }
    EXPECT_GT(chi_square_test(places, std::vector<double>(36, kPhotons / 36.0)).p_value, chance) << faces[f];
    EXPECT_GT(chi_square_test(angles, std::vector<double>(20, kPhotons / 20.0)).p_value, chance) << faces[f];
  }
}

}  // namespace
}  // namespace evenglow::tests

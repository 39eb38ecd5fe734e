#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Plates with each clear shape, traced whole. Seeds are fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using tracer::Side;

const std::vector<std::string> kShapes = {
    "kind: microlens",
    "kind: microlens, form: sunk",
    "kind: cone, aspect: 0.3",
    "kind: cone, form: sunk, truncation: 0.5",
    "kind: pyramid, axis_deg: 30",
    "kind: pyramid, form: sunk",
    "kind: v_groove",
    "kind: v_groove, form: sunk, flanks_deg: [30, 60]",
};

/// A clear plate, lit at its left edge by light that a bare plate keeps to its right edge.
std::string plate_with(const std::string& shape, const std::string& face, double density) {
  return "light_guide_plate: {length_mm: 40, width_mm: 20, thickness_mm: 1, refractive_index: 1.49}, microstructure: "
         "{cells: [4, 2], density: " +
         text_of(density) + ", face: " + face + ", " + shape + "}, sources: [{kind: lambertian_face, face: left}]";
}

/// Each shape, on each face, throws guided light out of the plate, on both sides, and absorbs nothing; the bare plate
/// sends nothing up or down.
TEST(MicrostructureScenes, ShapesExtractAndAbsorbNothing) {
  const Traced bare(plate_with(kShapes[0], "bottom", 0.0), {20'000, 1, 10, 1});
  EXPECT_EQ(bare.escaped(Side::kTop) + bare.escaped(Side::kBottom), 0.0);
  for (const std::string& shape : kShapes) {
    for (const std::string face : {"bottom", "top"}) {
      const Traced traced(plate_with(shape, face, 0.2), {20'000, 1, 10, 1});
      EXPECT_EQ(traced.accounted(), traced.photons()) << shape << face;
      EXPECT_EQ(traced.lost() + traced.absorbed("microstructure") + traced.absorbed("light_guide_plate"), 0.0)
          << shape << face;
      EXPECT_GT(traced.escaped(Side::kTop), 0.05 * traced.photons()) << shape << face;
      EXPECT_GT(traced.escaped(Side::kBottom), 0.05 * traced.photons()) << shape << face;
    }
  }
}

/// A pattern on the top face is the one on the bottom face upside down: what left by the top leaves by the bottom. (The
/// grooves and pyramids keep their axes in the plate, so that these count from the same x and y.)
TEST(MicrostructureScenes, TopIsTheMirrorImageOfBottom) {
  std::vector<std::string> shapes = kShapes;
  shapes.push_back("kind: v_groove, flanks_deg: [20, 70], axis_deg: 60");
  const double limit = z_limit(1e-3, 4 * shapes.size());
  std::uint64_t seed = 10;
  for (const std::string& shape : shapes) {
    const Traced below(plate_with(shape, "bottom", 0.3), {40'000, ++seed, 10, 1});
    const Traced above(plate_with(shape, "top", 0.3), {40'000, ++seed, 10, 1});
    const auto z = [&](Side in_one, Side in_other) {
      const double a = below.escaped(in_one), b = above.escaped(in_other);
      return a + b > 0.0 ? (a - b) / std::sqrt(a + b) : 0.0;  // nothing leaves sideways by a groove
    };
    EXPECT_LT(std::abs(z(Side::kTop, Side::kBottom)), limit) << shape;
    EXPECT_LT(std::abs(z(Side::kBottom, Side::kTop)), limit) << shape;
    EXPECT_LT(std::abs(z(Side::kRight, Side::kRight)), limit) << shape;
    // Which side of the axis the light is sent to.
    EXPECT_LT(std::abs(z(Side::kFront, Side::kFront)), limit) << shape;
  }
}

/// Reciprocity of a whole patterned plate between two Lambertian sheets: of the light that starts diffusely at the
/// lower sheet the upper one absorbs the share that the lower one absorbs of light from the upper one, however lopsided
/// the shape. The walls are mirrors.
TEST(MicrostructureScenes, PlateBetweenWhiteSheetsIsReciprocal) {
  constexpr double kPhotons = 40'000;
  const double limit = z_limit(1e-3, kShapes.size());
  std::uint64_t seed = 100;
  for (const std::string& shape : kShapes) {
    const auto room = [&](const std::string& lit) {
      const std::string mirror = ": {kind: mirror, reflectance: 1, gap_mm: 0.001}, ";
      return "light_guide_plate: {length_mm: 200, width_mm: 200, thickness_mm: 1, refractive_index: 1.49}, "
             "microstructure: {cells: [2, 2], density: 0.6, " +
             shape + "}, reflectors: {left" + mirror + "right" + mirror + "front" + mirror + "back" + mirror +
             "bottom: {kind: white, reflectance: 0.8, gap_mm: 0.01}, top: {kind: white, reflectance: 0.6, gap_mm: "
             "0.01}}, sources: [{kind: lambertian_face, face: " +
             lit + ", gap_mm: 0.005}]";
    };
    const auto crossed = [&](const std::string& lit, const std::string& sheet) {
      const Traced traced(room(lit), {static_cast<std::uint64_t>(kPhotons), ++seed, 10, 1});
      EXPECT_EQ(traced.accounted(), traced.photons()) << shape;
      return traced.absorbed("reflectors." + sheet) / kPhotons;
    };
    // Of what a Lambertian sheet of reflectance R absorbs, 1 - R of what it meets; what it meets is reciprocal.
    const double up = crossed("bottom", "top") / 0.4, down = crossed("top", "bottom") / 0.2;
    const double se = std::hypot(std::sqrt(up * 0.4 * (1.0 - up * 0.4) / kPhotons) / 0.4,
                                 std::sqrt(down * 0.2 * (1.0 - down * 0.2) / kPhotons) / 0.2);
    EXPECT_LT(std::abs(up - down) / se, limit) << shape << " " << up << " " << down;
  }
}

}  // namespace
}  // namespace evenglow::tests

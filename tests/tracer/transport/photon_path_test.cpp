#include "tracer/transport/photon_path.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tracer {
namespace {

const char* const kSlab =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1, refractive_index: 1.5}, "
    "microstructure: {cells: [4, 2], density: 0.3}, sources: [{kind: lambertian_face, face: left, flux_lm: 1}], "
    "reflectors: {bottom: {kind: white, reflectance: 0.9}, right: {kind: mirror, reflectance: 0.9}}, "
    "films: [{kind: dbef}]";

TEST(PhotonPath, EndsAsTheTraceItselfCountsIt) {
  const Scene scene = tests::scene_of(kSlab);
  const DensityField density = initial_density(scene.spec);
  TraceOptions options;
  options.photons = 400;
  options.batches = 10;
  options.key = {5, 0, 0};
  options.threads = 1;
  options.path = TracePath::kGeneral;
  const auto result = trace(scene, density, options);
  ASSERT_TRUE(result);
  std::map<std::string, int> fates;
  for (std::uint64_t i = 0; i < options.photons; ++i) ++fates[record_path(scene, density, options.key, i).fate];
  for (int side = 0; side < kSides; ++side) {
    const auto name = std::string("leaves by ") + side_name(static_cast<Side>(side));
    EXPECT_EQ(fates[name], result->energy.total(static_cast<std::size_t>(side)).value) << name;
  }
  for (std::size_t part = 0; part < scene.energy.parts().size(); ++part) {
    EXPECT_EQ(fates["absorbed by " + scene.energy.parts()[part]],
              result->energy.total(scene.energy.absorbed_bin(static_cast<int>(part))).value);
  }
}

TEST(PhotonPath, ItsStretchesAreStraightAlongItsDirections) {
  const Scene scene = tests::scene_of(kSlab);
  const DensityField density = initial_density(scene.spec);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const PhotonPath path = record_path(scene, density, {5, 0, 0}, i);
    ASSERT_FALSE(path.vertices.empty());
    EXPECT_EQ(path.vertices.front().at, "source");
    for (std::size_t j = 0; j + 1 < path.vertices.size(); ++j) {
      const core::Vec3 way = path.vertices[j + 1].position - path.vertices[j].position;
      EXPECT_NEAR((way - way.dot(path.vertices[j].light.frame.k) * path.vertices[j].light.frame.k).norm(), 0.0, 1e-7);
    }
    const core::Vec3 last = path.end - path.vertices.back().position;
    EXPECT_NEAR(last.cross(path.vertices.back().light.frame.k).norm(), 0.0, 1e-6);
  }
}

TEST(PhotonPath, KeepsAsManyPointsAsItIsTold) {
  const Scene scene = tests::scene_of(kSlab);
  const DensityField density = initial_density(scene.spec);
  const PhotonPath whole = record_path(scene, density, {5, 0, 0}, 3);
  const PhotonPath cut = record_path(scene, density, {5, 0, 0}, 3, 2);
  EXPECT_LE(cut.vertices.size(), 2u);
  EXPECT_EQ(cut.events, whole.events);
  EXPECT_EQ(cut.fate, whole.fate);
  EXPECT_EQ(whole.events, whole.vertices.size());
}

}  // namespace
}  // namespace evenglow::tracer

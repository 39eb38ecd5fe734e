#include "tracer/transport/planar_plate_walk.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/transport/planar_history.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

/// Keeps every arrival.
struct Recorder {
  static constexpr bool kActive = true;
  std::vector<PatternArrival> arrivals;
  void operator()(const PatternArrival& arrival) { arrivals.push_back(arrival); }
};

std::string backlight(const std::string& face) {
  return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, refractive_index: 1.5}, microstructure: "
         "{face: " +
         face +
         ", cells: [4, 2], density: 0.2}, sources: [{kind: lambertian_face, face: left}], reflectors: {bottom: {}, "
         "top: "
         "{gap_mm: 1}}";
}

/// Every arrival at the patterned face is told, in its cell and on its plane, and the pattern is met with the odds of
/// the cell's density. False alarm 1e-3 for all 16 tests.
TEST(PlanarPlateWalk, TellsEveryArrivalAndMeetsThePatternAsOftenAsItsDensity) {
  for (const char* face : {"bottom", "top"}) {
    const Scene scene = scene_of(backlight(face));
    DensityField density = initial_density(scene.spec);
    for (std::size_t i = 0; i < 8; ++i) density.cells.values[i] = 0.05 + 0.1 * static_cast<double>(i);
    const auto layers = PlanarScene::of(scene);
    const BasicPlanarHistory<MeridianLight, Recorder> history(scene, *layers, density);
    const PlanarHistory silent(scene, *layers, density);
    BatchSums sums(scene), same(scene);
    Recorder recorder;
    for (std::uint64_t i = 0; i < 10'000; ++i) {
      history.run({1, 0, 0}, i, sums, recorder);
      silent.run({1, 0, 0}, i, same);
    }
    EXPECT_EQ(sums.energy, same.energy);  // to look on changes nothing
    std::vector<double> arrived(8, 0.0), met(8, 0.0);
    for (const PatternArrival& a : recorder.arrivals) {
      EXPECT_EQ(a.position.z(), face == std::string("top") ? 2.0 : 0.0);
      EXPECT_EQ(a.cell, static_cast<std::size_t>(density.cells.grid.nearest_index(a.position.x(), a.position.y())));
      EXPECT_NEAR(a.light.kx * a.light.kx + a.light.ky * a.light.ky + a.light.kz * a.light.kz, 1.0, 1e-12);
      EXPECT_LE(std::hypot(a.light.Q, a.light.U, a.light.V), a.light.I * (1.0 + 1e-12));
      arrived[a.cell] += 1.0;
      met[a.cell] += a.met ? 1.0 : 0.0;
    }
    for (std::size_t i = 0; i < 8; ++i) {
      ASSERT_GT(arrived[i], 500.0);
      EXPECT_LT(std::abs(binomial_z(met[i], arrived[i], density.cells.values[i])), z_limit(1e-3, 16)) << i << face;
    }
  }
}

}  // namespace
}  // namespace evenglow::tests

#include "tracer/transport/viewer_subpath.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/light/fresnel.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string scene_text(const std::string& films_above) {
  return "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: "
         "[{kind: diffuser, transmittance: 0.6, reflectance: 0.3, lobe: lambertian, depolarization: 1}" +
         films_above + "]";
}

/// Importance at the diffuser (the primary level) for light that leaves it upwards, in the tangential count, summed
/// over the arrivals of a subpath: mean and standard error over many.
struct Mean {
  Eigen::Vector4d value = Eigen::Vector4d::Zero(), se = Eigen::Vector4d::Zero();
};

Mean importance(const Scene& scene, const core::Vec3& k, int subpaths) {
  const ViewerLevels levels(scene);
  const ViewerSubpath subpath(scene, levels);
  core::PhotonRng rng({20260706, 0, 0}, 0);
  int level = 0;
  while (!levels[level].primary) ++level;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero(), squares = Eigen::Vector4d::Zero();
  for (int i = 0; i < subpaths; ++i) {
    ViewerArrivals arrivals(levels.all().size());
    subpath.add({k, 1.0}, 0, rng, arrivals);
    Eigen::Vector4d mine = Eigen::Vector4d::Zero();
    for (const ViewerArrival& arrival : arrivals.lists[ViewerArrivals::list(level, true)]) {
      EXPECT_NEAR((arrival.importance.frame.k - k).norm(), 0.0, 1e-12);
      mine += to_film(arrival.importance, tangential_frame(k));
    }
    sum += mine;
    squares += mine.cwiseProduct(mine);
  }
  Mean mean;
  mean.value = sum / subpaths;
  mean.se = ((squares / subpaths - mean.value.cwiseProduct(mean.value)) / subpaths).cwiseMax(0.0).cwiseSqrt();
  return mean;
}

void expect_row(const Mean& mean, const Eigen::RowVector4d& expected, std::size_t comparisons) {
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT(std::abs(z_score({mean.value[i], mean.se[i]}, expected[i])), z_limit(1e-3, comparisons))
        << i << ": " << mean.value[i] << " +- " << mean.se[i] << ", expected " << expected[i];
  }
}

/// Films that reflect and transmit against the sum over all reflections between them, written out order by order.
TEST(ViewerSubpath, HoldsAllOrdersBetweenFilms) {
  const Scene scene =
      scene_of(scene_text(", {kind: dbef, axis_deg: 20, transmittance_pass: 0.8, reflectance_pass: 0.15, "
                          "transmittance_block: 0.1, reflectance_block: 0.85}"
                          ", {kind: retarder, axis_deg: 10, retardance_nm: 100}"
                          ", {kind: dbef, axis_deg: 65, transmittance_pass: 0.7, reflectance_pass: 0.2, "
                          "transmittance_block: 0.05, reflectance_block: 0.9}"));
  for (const core::Vec3& k : {travel(0, 0, true), travel(30, 70, true), travel(65, 200, true)}) {
    const Bsdf& a = *scene.spec.films[1].surface;
    const Bsdf& r = *scene.spec.films[2].surface;
    const Bsdf& b = *scene.spec.films[3].surface;
    const core::Vec3 down(k.x(), k.y(), -k.z());
    core::MuellerMatrix sum = core::MuellerMatrix::Zero(),
                        at_top = r.specular(k).transmission * a.specular(k).transmission;
    for (int order = 0; order < 400; ++order) {
      sum += b.specular(k).transmission * at_top;
      at_top = r.specular(k).transmission * a.specular(down).reflection * r.specular(down).transmission *
               b.specular(k).reflection * at_top;
    }
    expect_row(importance(scene, k, 40'000), sum.row(0), 12);
  }
}

TEST(ViewerSubpath, ThreeSheetsAgreeWithTheClosedForm) {
  const std::string sheet = ", {kind: sheet, refractive_index: 1.5}";
  const Scene scene = scene_of(scene_text(sheet + sheet + sheet));
  for (const double degrees : {0.0, 40.0, 75.0}) {
    const core::Vec3 k = travel(degrees, 20, true);
    const core::FresnelFace face = core::fresnel(k.z(), 1.0, 1.5);
    const auto stack = [](double R) { return (1.0 - R) / (1.0 + 5.0 * R); };  // 2 N - 1 = 5
    const double p = stack(face.reflectance_p()), s = stack(face.reflectance_s());
    expect_row(importance(scene, k, 40'000), {0.5 * (p + s), 0.5 * (p - s), 0.0, 0.0}, 12);
  }
}

/// The straight way through a thick sheet between two gaps of air, to where the light leaves.
TEST(ViewerSubpath, KnowsWhereTheLightLeaves) {
  const Scene scene = scene_of(
      scene_text(", {kind: sheet, refractive_index: 1.5, thickness_mm: 3, gap_mm: 1}, {kind: lpp, gap_mm: 2}"));
  const ViewerLevels levels(scene);
  const ViewerSubpath subpath(scene, levels);
  core::PhotonRng rng({1, 0, 0}, 0);
  ViewerArrivals arrivals(levels.all().size());
  for (int i = 0; i < 20; ++i) subpath.add({travel(50, 90, true), 1.0}, 0, rng, arrivals);
  int level = 0;
  while (!levels[level].primary) ++level;
  const auto& list = arrivals.lists[ViewerArrivals::list(level, true)];
  ASSERT_FALSE(list.empty());
  const double s = std::sin(50.0 * core::kRadPerDeg);
  const double way = 3.0 * s / std::sqrt(1.0 - s * s) + 3.0 * s / std::sqrt(2.25 - s * s);
  int straight = 0;
  for (const ViewerArrival& arrival : list) {
    EXPECT_NEAR(arrival.display.x(), 0.0, 1e-9);
    EXPECT_GE(arrival.display.y(), way - 1e-9);  // farther if it went to and fro
    if (arrival.display.y() > way + 1e-9) continue;
    ++straight;
    EXPECT_NEAR(arrival.outer.min.y(), s / std::sqrt(1.0 - s * s), 1e-9);  // met next: the sheet, 1 mm above
    EXPECT_NEAR(arrival.outer.max.y(), way, 1e-9);
  }
  EXPECT_GT(straight, 10);
}

/// Through the patterned face to the bottom, the smooth part of it passed once.
TEST(ViewerSubpath, TellsItsPassagesOfThePattern) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [2, 2]}, reflectors: {bottom: {}}, "
      "sources: [{kind: led_row, count: 2}]");
  const ViewerLevels levels(scene);
  const ViewerSubpath subpath(scene, levels);
  core::PhotonRng rng({1, 0, 0}, 0);
  ViewerArrivals arrivals(levels.all().size());
  for (int i = 0; i < 200; ++i) subpath.add({travel(10, 0, true), 1.0}, 0, rng, arrivals);
  const auto& dots = arrivals.lists[ViewerArrivals::list(1, true)];
  const auto& bottom = arrivals.lists[ViewerArrivals::list(0, true)];
  ASSERT_GT(dots.size(), 150U);
  ASSERT_GT(bottom.size(), 150U);
  int direct = 0;
  for (const ViewerArrival& arrival : dots) direct += arrival.crossings == 0 ? 1 : 0;
  EXPECT_GT(direct, 150);
  for (const ViewerArrival& arrival : bottom) {
    ASSERT_GE(arrival.crossings, 1U);
    const core::Vec2 last = arrivals.crossings[arrival.first_crossing + arrival.crossings - 1].place;
    EXPECT_GT(last.x(), 0.0);  // on the way to the right
    EXPECT_LT(last.x(), arrival.display.x());
  }
  EXPECT_TRUE(arrivals.lists[ViewerArrivals::list(1, false)].empty());  // a white bottom sends nothing straight up
}

}  // namespace
}  // namespace evenglow::tests

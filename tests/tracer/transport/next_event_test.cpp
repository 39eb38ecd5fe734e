#include "tracer/transport/next_event.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/light/fresnel.h"
#include "tests/support/film_bins.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string scene_text(const std::string& films_above, const std::string& receiver = "cells: [1, 1]") {
  return "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: "
         "[{kind: diffuser, transmittance: 0.6, reflectance: 0.3, lobe: lambertian, depolarization: 1}" +
         films_above + "], receivers: [{kind: luminance, " + receiver + "}]";
}

/// A photon that comes from below to the first film of the scene, again and again: the luminance scores of each cell.
class Scatters {
 public:
  explicit Scatters(const std::string& text)
      : scene_(scene_of(text)), density_(initial_density(scene_.spec)), next_event_(scene_, density_), sums_(scene_) {}

  /// True if it was estimated.
  bool at(const core::Vec3& position) {
    const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(travel(50, 0, true)));
    const core::Vec3 weight = core::Vec3::Ones();
    const auto& surfaces = scene_.optics[0].surfaces;
    const Bsdf* film = scene_.spec.films[0].surface.get();
    int quad = 0;
    while (surfaces[static_cast<std::size_t>(quad)].optics != film) ++quad;
    NextEvent::Coverage coverage;
    return next_event_.meet(coverage, {quad, *film, light, position, 0, weight}, sums_);
  }
  const std::vector<double>& scores() const { return sums_.luminance; }
  double take() {
    double sum = 0.0;
    for (double& score : sums_.luminance) {
      sum += score;
      score = 0.0;
    }
    return sum;
  }

 private:
  Scene scene_;
  DensityField density_;
  NextEvent next_event_;
  BatchSums sums_;
};

/// A Lambertian scatterer under the open sky and under a polarizer: T / pi times what that lets through.
TEST(NextEvent, ScoreOfALambertianScatterer) {
  Scatters bare(scene_text(""));
  Scatters covered(scene_text(", {kind: lpp, k1: 0.8, k2: 0.02, reflectance: 0}"));
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(bare.at({10, 5, 0.05}));
    EXPECT_NEAR(bare.take(), 0.6 / core::kPi, 1e-14);
    EXPECT_TRUE(covered.at({10, 5, 0.05}));
    EXPECT_NEAR(covered.take(), 0.6 * 0.41 / core::kPi, 1e-14);
  }
}

TEST(NextEvent, OutsideTheActiveAreaNothingIsScored) {
  Scatters scatters(scene_text("", "cells: [2, 1], margins: {left_mm: 5}"));
  EXPECT_TRUE(scatters.at({4.9, 5, 0.05}));
  EXPECT_EQ(scatters.take(), 0.0);
  scatters.at({6.0, 5, 0.05});
  EXPECT_GT(scatters.scores()[0], 0.0);
  EXPECT_EQ(scatters.scores()[1], 0.0);
  scatters.take();
  scatters.at({19.0, 5, 0.05});
  EXPECT_EQ(scatters.scores()[0], 0.0);
}

/// A plate with white dots over a white bottom, under a diffuser, and a photon that is led by hand.
class LedPhoton {
 public:
  LedPhoton()
      : scene_(
            scene_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1}, microstructure: {cells: [1, "
                     "1], density: 0.5}, sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: {}}, "
                     "films: [{kind: diffuser, haze: 0.5}, {kind: lpp}], receivers: [{kind: luminance, cells: [1, "
                     "1]}]")),
        density_(initial_density(scene_.spec)),
        next_event_(scene_, density_),
        sums_(scene_) {}

  enum Place { kBottomSheet, kPlateBottom, kPlateTop, kDiffuser, kLpp };
  /// Meets the level's own optics (or the pattern) and leaves it; true: estimated.
  bool meet(Place place, bool up, bool specular, bool pattern = false) {
    const ViewerLevel& level = next_event_.levels()[place];
    return meet_quad(level.quad, travel(20, 0, up), {10, 5, level.z}, specular, pattern);
  }
  /// Meets a wall of the plate from inside.
  void meet_wall(Side side, const core::Vec3& k) { meet_quad(static_cast<int>(side), k, {20, 5, 0.5}, true, false); }
  bool covered() const { return coverage_.covered; }
  bool counted_at_exit() const { return !next_event_.covers(coverage_, scene_.box.max); }

 private:
  bool meet_quad(int quad, const core::Vec3& k, const core::Vec3& position, bool specular, bool pattern) {
    const Surface& surface = scene_.optics[0].surfaces[static_cast<std::size_t>(quad)];
    const core::Vec3 local(surface.x.dot(k), surface.y.dot(k), surface.normal.dot(k));
    const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(local));
    const core::Vec3 weight = core::Vec3::Ones();
    const NextEvent::Meeting meeting{quad, pattern ? *surface.pattern : *surface.optics, light, position, 0, weight};
    const bool estimated = next_event_.meet(coverage_, meeting, sums_);
    next_event_.leave(coverage_, meeting, estimated, specular);
    return estimated;
  }

  Scene scene_;
  DensityField density_;
  NextEvent next_event_;
  BatchSums sums_;
  NextEvent::Coverage coverage_;
};

/// The rules of docs/theory.md, one by one.
TEST(NextEvent, CoverageIsKeptFromLevelToLevel) {
  LedPhoton photon;
  EXPECT_TRUE(photon.meet(LedPhoton::kPlateBottom, false, false, true));  // a dot
  EXPECT_TRUE(photon.covered());
  photon.meet(LedPhoton::kPlateTop, true, true);
  EXPECT_FALSE(photon.meet(LedPhoton::kDiffuser, true, false));  // covered: no second estimate
  EXPECT_TRUE(photon.covered());
  photon.meet(LedPhoton::kLpp, true, true);
  EXPECT_FALSE(photon.counted_at_exit());
}

TEST(NextEvent, PrimaryLevelsAlwaysEstimate) {
  LedPhoton photon;
  photon.meet(LedPhoton::kPlateBottom, false, false, true);
  photon.meet(LedPhoton::kPlateTop, true, true);
  photon.meet(LedPhoton::kPlateBottom, false, true);  // its smooth part
  EXPECT_TRUE(photon.covered());
  EXPECT_TRUE(photon.meet(LedPhoton::kBottomSheet, false, false));
  EXPECT_TRUE(photon.covered());
}

TEST(NextEvent, UncoveredLightIsEstimatedAtTheNextFilmOrCounted) {
  LedPhoton straight;
  straight.meet(LedPhoton::kPlateTop, true, true);
  EXPECT_TRUE(straight.meet(LedPhoton::kDiffuser, true, true));  // passes without scatter
  EXPECT_FALSE(straight.covered());
  straight.meet(LedPhoton::kLpp, true, true);
  EXPECT_TRUE(straight.counted_at_exit());
  LedPhoton scattered;
  scattered.meet(LedPhoton::kPlateTop, true, true);
  scattered.meet(LedPhoton::kDiffuser, true, false);
  scattered.meet(LedPhoton::kLpp, true, true);
  EXPECT_FALSE(scattered.counted_at_exit());
}

/// From the bottom sheet past the plate to the films, which no path from the viewer does.
TEST(NextEvent, LeavingOutALevelEndsCoverage) {
  LedPhoton photon;
  photon.meet(LedPhoton::kBottomSheet, false, false);
  EXPECT_TRUE(photon.covered());
  EXPECT_TRUE(photon.meet(LedPhoton::kDiffuser, true, false));
  EXPECT_TRUE(photon.covered());  // by its own estimate
}

TEST(NextEvent, WallsMirrorDotsByTotalReflectionOnly) {
  const core::Vec3 steep = travel(30, 0, true), flat = travel(80, 0, true);
  LedPhoton kept;
  kept.meet(LedPhoton::kPlateBottom, false, false, true);
  kept.meet_wall(Side::kRight, steep);
  EXPECT_TRUE(kept.covered());
  kept.meet_wall(Side::kRight, steep);  // a second time: no image does that
  EXPECT_FALSE(kept.covered());
  LedPhoton refracted;
  refracted.meet(LedPhoton::kPlateBottom, false, false, true);
  refracted.meet_wall(Side::kRight, flat);
  EXPECT_FALSE(refracted.covered());
  LedPhoton late;
  late.meet(LedPhoton::kPlateBottom, false, false, true);
  late.meet(LedPhoton::kPlateTop, true, true);  // polarized by now
  late.meet_wall(Side::kRight, steep);
  EXPECT_FALSE(late.covered());
}

}  // namespace
}  // namespace evenglow::tests

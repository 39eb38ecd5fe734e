#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/two_paths.h"
#include "tests/support/z_test.h"
#include "tracer/microstructure/dot_grid.h"

/// Patterns that are traced dot by dot: the planar path against the general one, the next-event estimate against
/// counting, and real dots against the density that they give. Seeds fixed. Entries and means: |z| for all comparisons
/// of a scene together with a false alarm of 0.27 % (3 sigma); cells by chi-square.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr double kThreeSigma = 0.0027;
constexpr FaceArea kFace = {0.0, 30.0, 0.0, 20.0};

/// Dots by chance; `apart`: none within 1.05 diameters of another.
std::shared_ptr<const DotGrid> random_dots(std::size_t count, double diameter, core::Footprint footprint, bool apart,
                                           unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  core::DotPattern dots;
  const double reach = 0.75 * diameter;
  // Boxes as large as the least distance, each with the dot that it holds.
  const double box = 1.05 * core::footprint_span(footprint, diameter);
  const int nx = static_cast<int>(30.0 / box) + 1, ny = static_cast<int>(20.0 / box) + 1;
  std::vector<std::vector<std::size_t>> held(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  while (dots.size() < count) {
    const core::Dot dot{reach + u(random) * (30.0 - 2.0 * reach), reach + u(random) * (20.0 - 2.0 * reach),
                        static_cast<float>(0.5 * diameter), static_cast<float>(3.0 * u(random))};
    const int ix = static_cast<int>(dot.x / box), iy = static_cast<int>(dot.y / box);
    bool free = true;
    for (int y = std::max(0, iy - 1); apart && y <= std::min(ny - 1, iy + 1); ++y) {
      for (int x = std::max(0, ix - 1); x <= std::min(nx - 1, ix + 1); ++x) {
        for (const std::size_t other : held[static_cast<std::size_t>(y * nx + x)])
          free = free && std::hypot(dots[other].x - dot.x, dots[other].y - dot.y) > box;
      }
    }
    if (!free) continue;
    held[static_cast<std::size_t>(iy * nx + ix)].push_back(dots.size());
    dots.push_back(dot);
  }
  return std::make_shared<const DotGrid>(dots, footprint, kFace);
}

const std::string kPlate =
    "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 1, refractive_index: 1.5, absorption_per_m: 2}, ";
const std::string kAround =
    "reflectors: {bottom: {reflectance: 0.95, gap_mm: 0.1}, right: {reflectance: 0.9, gap_mm: 0.2}, front: {kind: "
    "mirror, reflectance: 0.9}}, sources: [{kind: led_row, count: 3, pitch_mm: 5, size_mm: [2.6, 0.4], gap_mm: "
    "0.05}], ";
const std::string kDiffuser =
    "films: [{kind: diffuser, transmittance: 0.88, reflectance: 0.1, haze: 0.95, fwhm_deg: 60}], ";

std::string receiver(const std::string& estimator, const std::string& cells = "64, 48") {
  return "receivers: [{kind: luminance, cells: [" + cells + "], cone_deg: 20, estimator: " + estimator + "}]";
}
std::string pattern(const std::string& keys) {
  return "microstructure: {cells: [30, 20], " + keys + "}, ";
}

/// A backlight and its dots.
struct DotScene {
  Scene scene;
  DensityField density;

  DotScene(const std::string& text, std::shared_ptr<const DotGrid> dots) : scene(scene_of(text)) {
    density = initial_density(scene.spec);
    density.cells = dots->coverage(density.cells.grid);
    density.dots = std::move(dots);
  }
  DensityField as_density() const { return {density.cells}; }
};

struct Case {
  const char* name;
  std::string keys;
  core::Footprint footprint;
  double diameter;
};

std::vector<Case> cases() {
  return {
      {"ink", "kind: printed_dot, reflectance: 0.9, specular_share: 0.2", core::Footprint::round, 0.1},
      {"square ink on top", "face: top, kind: printed_dot, transmittance: 0.05", core::Footprint::square, 0.1},
      {"sunk lenses", "kind: microlens, form: sunk, aspect: 0.2", core::Footprint::round, 0.1},
      {"raised cones", "kind: cone, flank_deg: 50", core::Footprint::round, 0.1},
      {"pyramids on top", "face: top, kind: pyramid, flank_deg: 45, form: sunk", core::Footprint::square, 0.08},
  };
}

void expect_paths_agree(const Case& c, const TraceSetup& setup, double chi_tolerance) {
  const auto dots = random_dots(12'000, c.diameter, c.footprint, c.keys.find("printed") == std::string::npos, 3);
  const DotScene dot(kPlate + kAround + pattern(c.keys) + kDiffuser + receiver("counting"), dots);
  ASSERT_TRUE(takes_planar_path(dot.scene, TracePath::kPlanar));
  const PathDifference d = difference_of(dot.scene, traced_by_both(dot.scene, dot.density, setup));
  const double per_cell = d.cells > 0 ? d.chi_square / d.cells : 1.0;
  EXPECT_LT(d.worst_z, z_limit(kThreeSigma, static_cast<std::size_t>(d.comparisons)))
      << c.name << ": " << d.worst_entry;
  EXPECT_NEAR(per_cell, 1.0, chi_tolerance) << c.name;
  EXPECT_NEAR(d.events_ratio, 1.0, 8.0 / std::sqrt(static_cast<double>(setup.photons))) << c.name;
  std::printf("%-20s worst of %2d entries: %.2f sigma (%s); chi-square per cell %.3f of %d; events %.5f\n", c.name,
              d.comparisons, d.worst_z, d.worst_entry.c_str(), per_cell, d.cells, d.events_ratio);
}

TEST(DotPath, PlanarAgreesWithGeneral) {
  for (const Case& c : cases()) expect_paths_agree(c, {40'000, 61, 40, 1}, 0.3);
}

TEST(DotPathLong, PlanarAgreesWithGeneral) {
  for (const Case& c : cases()) expect_paths_agree(c, {20'000'000, 62, 200, 0}, 0.08);
}

/// The same luminance and the same account, from two traces of their own, of two densities of one scene or of two
/// scenes that differ in the estimator alone.
void expect_same(const std::string& name, const Scene& a_scene, const DensityField& a, const Scene& b_scene,
                 const DensityField& b, const TraceSetup& setup, double chi_tolerance, TracePath path) {
  TraceOptions options;
  options.photons = setup.photons;
  options.batches = setup.batches;
  options.threads = setup.threads;
  options.path = path;
  options.key = {setup.seed, 0, 0};
  const auto one = trace(a_scene, a, options);
  options.key = {setup.seed, 1, 0};
  const auto other = trace(b_scene, b, options);
  const PathDifference d = difference_of(a_scene, {*one, *other});
  const double per_cell = d.cells > 0 ? d.chi_square / d.cells : 1.0;
  EXPECT_LT(d.worst_z, z_limit(kThreeSigma, static_cast<std::size_t>(d.comparisons))) << name << ": " << d.worst_entry;
  EXPECT_NEAR(per_cell, 1.0, chi_tolerance) << name;
  std::printf("%-20s worst of %2d entries: %.2f sigma (%s); chi-square per cell %.3f of %d\n", name.c_str(),
              d.comparisons, d.worst_z, d.worst_entry.c_str(), per_cell, d.cells);
}

void expect_estimators_agree(const Case& c, const std::string& cells, const TraceSetup& setup, double chi_tolerance,
                             TracePath path) {
  const auto dots = random_dots(12'000, c.diameter, c.footprint, c.keys.find("printed") == std::string::npos, 4);
  const std::string text = kPlate + kAround + pattern(c.keys) + kDiffuser;
  const DotScene next(text + receiver("next_event", cells), dots), count(text + receiver("counting", cells), dots);
  expect_same(c.name, next.scene, next.density, count.scene, count.density, setup, chi_tolerance, path);
}

TEST(DotPath, NextEventAgreesWithCounting) {
  for (const Case& c : cases()) {
    expect_estimators_agree(c, "5, 4", {60'000, 63, 40, 1}, 0.8, TracePath::kPlanar);
    expect_estimators_agree(c, "5, 4", {30'000, 64, 40, 1}, 0.8, TracePath::kGeneral);
  }
}

TEST(DotPathLong, NextEventAgreesWithCounting) {
  for (const Case& c : cases()) {
    expect_estimators_agree(c, "64, 48", {20'000'000, 65, 200, 0}, 0.08, TracePath::kPlanar);
    expect_estimators_agree(c, "64, 48", {20'000'000, 66, 200, 0}, 0.08, TracePath::kGeneral);
  }
}

/// Without a diffuser each dot stands sharp before the viewer: what is joined through the dots must know each of them.
/// A cell is as small as a few dots.
TEST(DotPathLong, NextEventAgreesWithCountingInBareView) {
  const auto dots = random_dots(1'200, 0.4, core::Footprint::round, false, 5);
  const std::string text = kPlate + kAround + pattern("kind: printed_dot, reflectance: 0.9");
  const DotScene next(text + receiver("next_event", "60, 40"), dots),
      count(text + receiver("counting", "60, 40"), dots);
  expect_same("bare view", next.scene, next.density, count.scene, count.density, {20'000'000, 67, 200, 0}, 0.08,
              TracePath::kPlanar);
}

/// Ink by chance, dots much smaller than the cells, is what a density says: the odds to meet it are the local coverage.
/// What is left of each cell's own number of dots is taken into account, as the density is the coverage as it is.
void expect_density(const std::string& estimator, const TraceSetup& setup, double chi_tolerance) {
  const auto dots = random_dots(180'000, 0.03, core::Footprint::round, false, 6);
  const DotScene dot(
      kPlate + kAround + pattern("kind: printed_dot, reflectance: 0.9") + kDiffuser + receiver(estimator, "30, 20"),
      dots);
  expect_same("density, " + estimator, dot.scene, dot.density, dot.scene, dot.as_density(), setup, chi_tolerance,
              TracePath::kPlanar);
}

TEST(DotPath, InkByChanceIsADensity) {
  expect_density("counting", {100'000, 68, 40, 1}, 0.3);
}

TEST(DotPathLong, InkByChanceIsADensity) {
  expect_density("counting", {10'000'000, 69, 200, 0}, 0.2);
  expect_density("next_event", {2'000'000, 70, 200, 0}, 0.2);
}

TEST(DotPath, SameBitsOnAnyNumberOfThreads) {
  const auto dots = random_dots(12'000, 0.1, core::Footprint::round, true, 7);
  for (const Case& c : {cases()[0], cases()[2]}) {
    const DotScene dot(kPlate + kAround + pattern(c.keys) + kDiffuser + receiver("next_event"), dots);
    TraceOptions options;
    options.photons = 8'000;
    options.batches = 40;
    options.threads = 1;
    options.key = {71, 0, 0};
    const auto one = trace(dot.scene, dot.density, options);
    for (const int threads : {2, 4}) {
      options.threads = threads;
      const auto many = trace(dot.scene, dot.density, options);
      for (std::size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(one->energy.batch(i), many->energy.batch(i));
        EXPECT_EQ(one->luminance.batch(i), many->luminance.batch(i));
      }
    }
  }
}

/// The wavefront asks for densities, and so do records of histories.
TEST(DotPath, WavefrontAndRecordsAreForDensities) {
  const auto dots = random_dots(100, 0.1, core::Footprint::round, true, 8);
  DotScene dot(kPlate + kAround + pattern("kind: printed_dot") + receiver("counting"), dots);
  TraceOptions options;
  options.photons = 1000;
  options.batches = 10;
  options.record_bytes = 1000000;
  EXPECT_EQ(trace(dot.scene, dot.density, options)->records, nullptr);
  dot.scene.spec.microstructure->dots = dots;
  options.path = TracePath::kWavefront;
  try {
    trace(dot.scene, dot.density, options);
    ADD_FAILURE() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("backlight.microstructure.dots_file"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace evenglow::tests

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/config/config_node.h"
#include "tests/support/two_paths.h"
#include "tests/support/z_test.h"
#include "tracer/transport/wavefront_plate.h"

/// The wavefront against the scalar planar path: two independent traces of backlights that use every part of the vector
/// kernel. Seeds fixed. Each entry of the energy account and the mean luminance: |z| with the standard errors of both,
/// false alarm 0.27 % (3 sigma) for all entries of a scene together; the cells' luminance: chi-square.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr double kThreeSigma = 0.0027;

struct Case {
  std::string name, yaml;
};

const std::string kPlate =
    "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, refractive_index: 1.5, absorption_per_m: 2}, ";
const std::string kMirrors =
    "reflectors: {bottom: {reflectance: 0.95, gap_mm: 0.1}, left: {kind: mirror, reflectance: 0.9, gap_mm: 0.05}, "
    "right: {kind: mirror, reflectance: 0.9, gap_mm: 0.2}, front: {kind: mirror, reflectance: 0.95}, back: {kind: "
    "mirror, reflectance: 0.8, gap_mm: 0.25}}, ";
const std::string kWhite =
    "reflectors: {bottom: {kind: mirror, reflectance: 0.9}, left: {gap_mm: 0.1}, right: {gap_mm: 0.2, reflectance: "
    "0.8}, front: {gap_mm: 0.001}, back: {gap_mm: 0.3}}, ";
const std::string kFace = "sources: [{kind: lambertian_face, face: left}], ";
const std::string kLeds =
    "sources: [{kind: led_row, edge: left, count: 3, pitch_mm: 5, size_mm: [2.6, 0.4], gap_mm: 0.05}, {kind: led_row, "
    "edge: back, count: 3, pitch_mm: 5, size_mm: [2.6, 0.4], gap_mm: 0.2}], ";
const std::string kDots = "microstructure: {cells: [7, 5], density: 0.3}, ";
const std::string kCells = "receivers: [{kind: luminance, cells: [64, 48], cone_deg: 20, estimator: counting}]";
const std::string kDiffuser = "{kind: diffuser, transmittance: 0.88, reflectance: 0.1, haze: 0.95, fwhm_deg: 60}";

/// Polarizing films over a plate without dots that scatter: what passes them depends on the phases of the plate's faces
/// and walls. `retarder`: makes the films turn circular light into linear light.
std::string polarizing(const std::string& film) {
  return "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, refractive_index: 1.6}, " + kMirrors +
         "sources: [{kind: lambertian_face, face: left}], microstructure: {cells: [7, 5], density: 0.1, reflectance: "
         "0.95, specular_share: 0.6}, films: [{kind: retarder, retardance_nm: 140, axis_deg: 45}, " +
         film + "], " + kCells;
}

std::vector<Case> cases() {
  return {
      {"bare slab", kPlate + kFace + kCells},
      {"dots, mirrors", kPlate + kMirrors + kFace + kDots + kCells},
      {"dots, white walls", kPlate + kWhite + kLeds + kDots + kCells},
      {"dots on top, partly mirrors", kPlate + kMirrors + kLeds +
                                          "microstructure: {face: top, cells: [7, 5], density: 0.2, reflectance: 0.9, "
                                          "specular_share: 0.3}, " +
                                          kCells},
      {"microlenses", kPlate + kMirrors + kLeds +
                          "microstructure: {cells: [7, 5], density: 0.4, kind: microlens, form: sunk, aspect: 0.2, "
                          "fill: 0.5}, " +
                          kCells},
      {"diffuser", kPlate + kMirrors + kFace + kDots + "films: [" + kDiffuser + "], " + kCells},
      {"films", kPlate + kWhite + kFace + kDots +
                    "films: [{kind: sheet, thickness_mm: 0.3, refractive_index: 1.6}, {kind: bef}, {kind: bef, "
                    "axis_deg: 90}, {kind: dbef, axis_deg: 30}], " +
                    kCells},
      {"grooves and a polarizer",
       "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, refractive_index: 1.7}, " + kMirrors + kFace +
           "microstructure: {cells: [7, 5], density: 0.1, kind: v_groove}, films: [{kind: lpp, axis_deg: 30}], " +
           kCells},
      {"ideal DBEF", polarizing("{kind: dbef, axis_deg: 20}")},
      {"absorbing polarizer", polarizing("{kind: dbef, axis_deg: 70}, {kind: lpp}")},
      {"serrated entrance",
       "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, entrance: {flank_deg: 35}}, " + kMirrors +
           kDots + kLeds + kCells},
      {"beam from above", kPlate + kMirrors + kDots +
                              "sources: [{kind: beam, face: top, angle_deg: 15}], films: [{kind: sheet, thickness_mm: "
                              "0.3}], " +
                              kCells},
      {"closed above", kPlate + "reflectors: {top: {reflectance: 0.9, gap_mm: 2}, left: {kind: mirror, gap_mm: 3}}, " +
                           kFace + kDots + kCells},
  };
}

/// The density of the spec times factors from 0.2 to 1.8 that leap from cell to cell.
DensityField uneven_density(const Scene& scene) {
  DensityField density = initial_density(scene.spec);
  for (std::size_t i = 0; i < density.cells.values.size(); ++i) {
    density.cells.values[i] *= 0.2 + 0.16 * static_cast<double>(7 * i % 11);
  }
  return density;
}

void expect_agreement(const std::string& name, const Scene& scene, const TraceSetup& setup, double chi_tolerance) {
  std::string reason;
  ASSERT_TRUE(wavefront_serves(scene, &reason)) << name << ": " << reason;
  const TwoPaths paths = traced_by(TracePath::kPlanar, TracePath::kWavefront, scene, uneven_density(scene), setup);
  const PathDifference d = difference_of(scene, paths);
  const double per_cell = d.cells > 0 ? d.chi_square / d.cells : 1.0;
  EXPECT_LT(d.worst_z, z_limit(kThreeSigma, static_cast<std::size_t>(d.comparisons))) << name << ": " << d.worst_entry;
  if (d.cells > 1000) {
    EXPECT_NEAR(per_cell, 1.0, chi_tolerance) << name;
  }
  // The spread of a photon's number of events is about its mean: 8 / sqrt(photons) is more than 4 sigma.
  EXPECT_NEAR(d.events_ratio, 1.0, 8.0 / std::sqrt(static_cast<double>(setup.photons))) << name;
  std::printf("%-28s worst of %2d entries: %.2f sigma (%s); chi-square per cell %.3f of %d; events %.5f\n",
              name.c_str(), d.comparisons, d.worst_z, d.worst_entry.c_str(), per_cell, d.cells, d.events_ratio);
}

TEST(WavefrontPath, AgreesWithThePlanarPath) {
  // 12 scenes: false alarm 12 x 0.27 %.
  for (const Case& c : cases()) expect_agreement(c.name, scene_of(c.yaml), {200'000, 21, 40, 1}, 0.3);
}

/// S1 and S2 of docs/performance.md, and S2 with crossed prism films.
std::vector<Case> bench_cases() {
  const std::string slab =
      "light_guide_plate: {length_mm: 100, width_mm: 60, thickness_mm: 3, material: pmma}, "
      "microstructure: {face: bottom, cells: [100, 60], kind: printed_dot, reflectance: 0.95, density: 0.2}, "
      "sources: [{kind: lambertian_face, face: left, flux_lm: 100}], "
      "reflectors: {bottom: {kind: white, reflectance: 0.98}, left: {kind: mirror, reflectance: 0.98}, right: {kind: "
      "mirror, reflectance: 0.98}, front: {kind: mirror, reflectance: 0.98}, back: {kind: mirror, reflectance: 0.98}}, "
      "receivers: [{kind: luminance, cells: [64, 48], cone_deg: 20, estimator: counting}]";
  const std::string diffuser =
      "{kind: diffuser, transmittance: 0.88, reflectance: 0.10, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}";
  return {{"S1", slab},
          {"S2, ideal DBEF", slab + ", films: [" + diffuser + ", {kind: dbef, axis_deg: 0}]"},
          {"S2, prism films",
           slab + ", films: [" + diffuser + ", {kind: bef, axis_deg: 0}, {kind: bef, axis_deg: 90}, {kind: dbef}]"}};
}

TEST(WavefrontPathLong, AgreesOnTheBenchmarksScenes) {
  for (const Case& c : bench_cases()) expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 61, 200, 2}, 0.08);
}

TEST(WavefrontPathLong, AgreesInEveryKindOfScene) {
  for (const Case& c : cases()) expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 31, 200, 2}, 0.08);
}

/// A shipped backlight whose luminance is counted.
Scene counted_config(const std::string& file, const std::string& variant) {
  const std::string path = std::string(EVENGLOW_SOURCE_DIR) + "/configs/" + file;
  std::ifstream stream(path);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string cone = "cone_deg: 10,";
  text.replace(text.find(cone), cone.size(), cone + " estimator: counting,");
  auto document = core::ConfigDocument::parse(text, path);
  for (const auto& [name, changes] : document.variants()) {
    if (name != variant) continue;
    for (const auto& change : changes) document.apply(change);
  }
  return compile_scene(read_backlight(document.root().map("backlight", "the backlight")));
}

TEST(WavefrontPathLong, AgreesForTheMainJob) {
  for (const char* variant : {"lpp", "dbef", "dbef_lpp"}) {
    expect_agreement(variant, counted_config("dbef_vs_lpp.yaml", variant), {20'000'000, 71, 200, 2}, 0.08);
  }
}

}  // namespace
}  // namespace evenglow::tests

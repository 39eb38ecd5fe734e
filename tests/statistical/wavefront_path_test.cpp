#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/path_agreement.h"
#include "tests/support/shipped_backlight.h"
#include "tracer/transport/wavefront_plate.h"

/// The wavefront against the scalar planar path: two independent traces of backlights that use every part of the vector
/// kernel. Seeds fixed, false alarm 0.27 % a scene.
namespace evenglow::tests {
namespace {

using namespace tracer;

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

std::vector<NamedBacklight> backlights() {
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
  expect_paths_agree(name, scene, paths, setup, chi_tolerance);
}

TEST(WavefrontPath, AgreesWithThePlanarPath) {
  // 12 scenes: false alarm 12 x 0.27 %.
  for (const NamedBacklight& c : backlights()) expect_agreement(c.name, scene_of(c.yaml), {200'000, 21, 40, 1}, 0.3);
}

/// S1 and S2 of docs/performance.md, and S2 with crossed prism films.
std::vector<NamedBacklight> bench_backlights() {
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
  for (const NamedBacklight& c : bench_backlights())
    expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 61, 200, 2}, 0.08);
}

TEST(WavefrontPathLong, AgreesInEveryKindOfScene) {
  for (const NamedBacklight& c : backlights())
    expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 31, 200, 2}, 0.08);
}

TEST(WavefrontPathLong, AgreesForTheMainJob) {
  for (const char* variant : {"lpp", "dbef", "dbef_lpp"}) {
    BacklightSpec spec = shipped_backlight("dbef_vs_lpp.yaml", variant);
    spec.luminance.estimator = LuminanceEstimator::kCounting;
    expect_agreement(variant, compile_scene(std::move(spec)), {20'000'000, 71, 200, 2}, 0.08);
  }
}

}  // namespace
}  // namespace evenglow::tests

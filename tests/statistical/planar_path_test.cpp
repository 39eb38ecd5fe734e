#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/config/config_node.h"
#include "tests/support/chi_square.h"
#include "tests/support/two_paths.h"
#include "tests/support/z_test.h"

/// The planar path against the general one: two independent traces of every kind of backlight that the planar path
/// takes. Seeds fixed. Each entry of the energy account and the mean luminance: |z| with the standard errors of both,
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
const std::string kAround =
    "reflectors: {bottom: {reflectance: 0.95, gap_mm: 0.1}, right: {reflectance: 0.9, gap_mm: 0.2}, front: {kind: "
    "mirror, reflectance: 0.9}}, ";
const std::string kFace = "sources: [{kind: lambertian_face, face: left}], ";
const std::string kCells = "receivers: [{kind: luminance, cells: [64, 48], cone_deg: 20, estimator: counting}]";

std::string led(const std::string& edge, const std::string& gap) {
  return "{kind: led_row, edge: " + edge + ", count: 3, pitch_mm: 5, size_mm: [2.6, 0.4], gap_mm: " + gap + "}";
}

std::vector<Case> cases() {
  const std::string dots = "microstructure: {cells: [7, 5], density: 0.3}, ";
  const std::string diffuser = "{kind: diffuser, transmittance: 0.88, reflectance: 0.1, haze: 0.95, fwhm_deg: 60}";
  return {
      {"bare slab", kPlate + kFace + kCells},
      {"dots on top", kPlate + kAround + kFace +
                          "microstructure: {face: top, cells: [7, 5], density: 0.2, reflectance: 0.9, specular_share: "
                          "0.3, transmittance: 0.05}, " +
                          kCells},
      {"microlenses", kPlate + kAround + "sources: [" + led("left", "0.05") +
                          "], microstructure: {cells: [7, 5], density: 0.4, kind: microlens, form: sunk, aspect: 0.2, "
                          "fill: 0.5}, " +
                          kCells},
      {"grooves on top", kPlate + kFace +
                             "microstructure: {face: top, cells: [7, 5], density: 0.4, kind: v_groove}, "
                             "films: [" +
                             diffuser + "], " + kCells},
      {"LEDs at four edges", kPlate + kAround + dots + "sources: [" + led("left", "0.05") + ", " + led("right", "0.2") +
                                 ", " + led("front", "0.05") + ", " + led("back", "0.05") + "], " + kCells},
      {"no plate, scattering sheet",
       "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], reflectors: {bottom: "
       "{reflectance: 0.9, gap_mm: 1}, left: {kind: mirror, reflectance: 1, gap_mm: 0.001}}, films: [{kind: sheet, "
       "thickness_mm: 0.3, refractive_index: 1.6, scattering_per_mm: 5, anisotropy: 0.8}, " +
           diffuser + ", {kind: lpp}], " + kCells},
      {"a sheet that touches mirrors",
       "size: {length_mm: 1, width_mm: 1}, sources: [{kind: lambertian_face, face: bottom}], reflectors: {bottom: "
       "{reflectance: 0.9, gap_mm: 0.1}, left: {kind: mirror, gap_mm: 0.001}, right: {kind: mirror, gap_mm: 0.001}, "
       "front: {kind: mirror, gap_mm: 0.001}, back: {kind: mirror, gap_mm: 0.001}}, films: [{kind: sheet, "
       "thickness_mm: "
       "0.5, refractive_index: 1.6, scattering_per_mm: 3, anisotropy: 0.5}], " +
           kCells},
      {"films", kPlate + kAround + kFace + dots +
                    "films: [{kind: sheet, thickness_mm: 0.3, refractive_index: 1.6}, {kind: retarder, retardance_nm: "
                    "140, axis_deg: 45}, {kind: bef}, {kind: bef, axis_deg: 90}, {kind: dbef, axis_deg: 30}], " +
                    kCells},
      {"beam from above", kPlate + kAround + dots +
                              "sources: [{kind: beam, face: top, angle_deg: 20}], films: [{kind: "
                              "sheet, thickness_mm: 0.3}], " +
                              kCells},
      {"closed above, mirrors", kPlate +
                                    "reflectors: {top: {reflectance: 0.9, gap_mm: 2}, left: {kind: mirror, "
                                    "reflectance: 1, gap_mm: 3}, right: {kind: mirror, reflectance: 0.5}}, " +
                                    kFace + dots + kCells},
      {"white walls that nearly touch",
       kPlate +
           "reflectors: {bottom: {gap_mm: 0.001}, left: {gap_mm: 0.001}, right: {gap_mm: 0.001}, "
           "front: {gap_mm: 0.001}, back: {kind: mirror, gap_mm: 0.001}}, " +
           kFace + dots + "films: [" + diffuser + "], " + kCells},
      {"serrated entrance",
       "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, entrance: {flank_deg: 35}}, " + kAround +
           dots + "sources: [" + led("left", "0.05") + "], " + kCells},
      {"bands", "light_guide_plate: {length_mm: 30, width_mm: 20, thickness_mm: 2, material: pmma}, " + kAround + dots +
                    "sources: [{kind: led_row, count: 3, pitch_mm: 5, spectrum: {kind: white_led}}], "
                    "films: [" +
                    diffuser + "], " + kCells},
  };
}

void expect_agreement(const std::string& name, const Scene& scene, const TraceSetup& setup, double chi_tolerance) {
  ASSERT_TRUE(takes_planar_path(scene, TracePath::kPlanar)) << name;
  const TwoPaths paths = traced_by_both(scene, initial_density(scene.spec), setup);
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

TEST(PlanarPath, AgreesWithTheGeneralPath) {
  // 13 scenes of few photons: false alarm 13 x 0.27 %.
  for (const Case& c : cases()) expect_agreement(c.name, scene_of(c.yaml), {40'000, 21, 40, 1}, 0.3);
}

TEST(PlanarPathLong, AgreesInEveryKindOfScene) {
  for (const Case& c : cases()) expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 31, 200, 0}, 0.08);
}

Scene scene_of_config(const std::string& file, const std::string& variant) {
  auto document = core::ConfigDocument::load(std::string(EVENGLOW_SOURCE_DIR) + "/configs/" + file);
  for (const auto& [name, changes] : document.variants()) {
    if (name != variant) continue;
    for (const auto& change : changes) document.apply(change);
  }
  return compile_scene(read_backlight(document.root().map("backlight", "the backlight")));
}

/// The three variants of the main job, and every backlight that is shipped.
TEST(PlanarPathLong, AgreesForTheShippedBacklights) {
  for (const char* variant : {"lpp", "dbef", "dbef_lpp"}) {
    expect_agreement(variant, scene_of_config("dbef_vs_lpp.yaml", variant), {20'000'000, 41, 200, 0}, 0.08);
  }
  for (const char* file : {"phone_dbef.yaml", "phone_lpp.yaml", "tablet_dbef.yaml", "monitor_two_edges.yaml",
                           "notebook_stack.yaml", "phone_stack.yaml", "monitor_stack.yaml"}) {
    expect_agreement(file, scene_of_config(file, ""), {20'000'000, 51, 200, 0}, 0.08);
  }
}

}  // namespace
}  // namespace evenglow::tests

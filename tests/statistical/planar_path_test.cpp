#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/path_agreement.h"
#include "tests/support/shipped_backlight.h"

/// The planar path against the general one: two independent traces of every kind of backlight that the planar path
/// takes. Seeds fixed, false alarm 0.27 % a scene.
namespace evenglow::tests {
namespace {

using namespace tracer;

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

std::vector<NamedBacklight> backlights() {
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
  expect_paths_agree(name, scene, paths, setup, chi_tolerance);
}

TEST(PlanarPath, AgreesWithTheGeneralPath) {
  // 13 scenes of few photons: false alarm 13 x 0.27 %.
  for (const NamedBacklight& c : backlights()) expect_agreement(c.name, scene_of(c.yaml), {40'000, 21, 40, 1}, 0.3);
}

TEST(PlanarPathLong, AgreesInEveryKindOfScene) {
  for (const NamedBacklight& c : backlights())
    expect_agreement(c.name, scene_of(c.yaml), {20'000'000, 31, 200, 0}, 0.08);
}

struct Shipped {
  std::string file, variant;
};

void PrintTo(const Shipped& shipped, std::ostream* os) {
  *os << shipped.file << " " << shipped.variant;
}

class PlanarPathShippedLong : public testing::TestWithParam<Shipped> {};

TEST_P(PlanarPathShippedLong, Agrees) {
  const auto& [file, variant] = GetParam();
  const Scene scene = compile_scene(shipped_backlight(file + ".yaml", variant));
  expect_agreement(file + " " + variant, scene, {20'000'000, 51, 200, 0}, 0.08);
}

/// The three variants of the main job, and every backlight that is shipped.
INSTANTIATE_TEST_SUITE_P(Configs, PlanarPathShippedLong,
                         testing::Values(Shipped{"dbef_vs_lpp", "lpp"}, Shipped{"dbef_vs_lpp", "dbef"},
                                         Shipped{"dbef_vs_lpp", "dbef_lpp"}, Shipped{"phone_dbef", ""},
                                         Shipped{"phone_lpp", ""}, Shipped{"tablet_dbef", ""},
                                         Shipped{"monitor_two_edges", ""}, Shipped{"notebook_stack", ""},
                                         Shipped{"phone_stack", ""}, Shipped{"monitor_stack", ""}),
                         [](const auto& shipped) { return shipped.param.file + "_" + shipped.param.variant; });

}  // namespace
}  // namespace evenglow::tests

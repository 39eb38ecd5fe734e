#include "design/dots/dot_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;
using ::testing::HasSubstr;

DotSpec spec_of(const std::string& map, core::Footprint footprint = core::Footprint::round) {
  auto document = core::ConfigDocument::parse("dots: " + map + "\n", "run.yaml");
  DotSpec spec = read_dots(document.root().map("dots", ""), footprint);
  document.finish();
  return spec;
}

std::string fault_of(const std::string& map) {
  try {
    spec_of(map);
  } catch (const core::ConfigError& error) {
    return error.faults()[0].to_string();
  }
  return "none";
}

TEST(DotSpec, HasDefaults) {
  const DotSpec spec = spec_of("{}");
  EXPECT_EQ(spec.mode, DotMode::spacing);
  EXPECT_DOUBLE_EQ(spec.diameter, 0.06);
  EXPECT_FALSE(spec.panel);
  EXPECT_EQ(spec_of("{}", core::Footprint::square).footprint, core::Footprint::square);
}

TEST(DotSpec, ReadsAllInMillimeters) {
  const DotSpec spec = spec_of(
      "{mode: lattice, diameters_um: [25, 80], gap_um: 5, pitch_um: 110, lattice: hexagonal, lattice_angle_deg: 30, "
      "size_step_um: 1, seed: 7, margins: {left_mm: 2}, keep_out: [{kind: circle, center_mm: [1, 2], radius_mm: 3}, "
      "{kind: rectangle, x_mm: [0, 1], y_mm: [2, 3]}], panel_pitch_um: [54, 162], process: {bias_um: 1.5}}");
  EXPECT_EQ(spec.mode, DotMode::lattice);
  EXPECT_DOUBLE_EQ(spec.diameter_max, 0.08);
  EXPECT_DOUBLE_EQ(spec.pitch, 0.11);
  EXPECT_EQ(spec.lattice, DotLattice::hexagonal);
  EXPECT_DOUBLE_EQ(spec.lattice_angle, 30.0 * core::kRadPerDeg);
  EXPECT_EQ(spec.margins.left, 2.0);
  EXPECT_EQ(spec.circles[0].radius, 3.0);
  EXPECT_EQ(spec.rectangles[0].y1, 3.0);
  EXPECT_DOUBLE_EQ(spec.panel->pitch_y, 0.162);
  EXPECT_DOUBLE_EQ(spec.process.bias, 0.0015);
}

TEST(DotSpec, TellsFaultsInOneLine) {
  EXPECT_THAT(fault_of("{diameter_um: 0}"),
              HasSubstr("run.yaml:1:21: dots.diameter_um: must lie in [0.5, 5000], got 0"));
  EXPECT_THAT(fault_of("{diameters_um: [80, 20]}"), HasSubstr("least <= greatest, got [80, 20]"));
  EXPECT_THAT(fault_of("{mode: both, size_step_um: 20}"),
              HasSubstr("at most a quarter of the least diameter, 7.5, got 20"));
  EXPECT_THAT(fault_of("{keep_out: [{kind: rectangle, x_mm: [2, 1], y_mm: [0, 1]}]}"),
              HasSubstr("must be from < to, got [2, 1]"));
  EXPECT_THAT(fault_of("{keep_out: [{kind: blob}]}"), HasSubstr("rectangle"));
  EXPECT_THAT(fault_of("{pitch: 3}"), HasSubstr("pitch_um"));
}

}  // namespace
}  // namespace evenglow::tests

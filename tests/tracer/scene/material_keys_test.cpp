#include "tracer/scene/material_keys.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;

std::function<Material(double)> material_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("plate: " + yaml, "run.yaml");
  auto material = read_material(document.root().map("plate", ""));
  document.finish();
  return material;
}

std::string faults_of(const std::string& yaml) {
  try {
    material_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(MaterialKeys, PmmaDisperses) {
  const auto pmma = material_of("{}");
  EXPECT_NEAR(pmma(450.0).refractive_index, 1.5006, 1e-4);
  EXPECT_NEAR(pmma(550.0).refractive_index, 1.4926, 1e-4);
  EXPECT_NEAR(pmma(550.0).absorption, 3e-5, 1e-12);
}

TEST(MaterialKeys, FormulasOfTheIndex) {
  // PMMA's own one-pole law, written out.
  const auto sellmeier = material_of("{dispersion: {kind: sellmeier, b: [1.1819], c_um2: [0.011313]}}");
  EXPECT_NEAR(sellmeier(450.0).refractive_index, 1.5006, 1e-4);
  EXPECT_EQ(sellmeier(450.0).absorption, 0.0);
  const auto cauchy = material_of("{dispersion: {kind: cauchy, a: 1.48, b_um2: 0.004}, absorption_per_m: 2}");
  EXPECT_NEAR(cauchy(500.0).refractive_index, 1.48 + 0.004 / 0.25, 1e-12);
  EXPECT_NEAR(cauchy(500.0).absorption, 0.002, 1e-15);
}

TEST(MaterialKeys, TablesAreLinearAndHeld) {
  const tests::TempFolder folder;
  tests::write_text(folder / "n.csv", "wavelength_nm,refractive_index\n450,1.5\n650,1.48\n");
  tests::write_text(folder / "a.csv", "wavelength_nm,absorption_per_m\n450,2\n650,1\n");
  const auto material = material_of("{dispersion: {kind: table, file: '" + (folder / "n.csv").string() +
                                    "'}, absorption_file: '" + (folder / "a.csv").string() + "'}");
  EXPECT_NEAR(material(550.0).refractive_index, 1.49, 1e-12);
  EXPECT_NEAR(material(400.0).refractive_index, 1.5, 1e-12);
  EXPECT_NEAR(material(700.0).absorption, 0.001, 1e-15);
  EXPECT_NEAR(material(500.0).absorption, 0.00175, 1e-15);
}

TEST(MaterialKeys, WrongOnesAreRefused) {
  EXPECT_THAT(faults_of("{material: pmma, dispersion: {kind: cauchy, a: 1.5}}"), HasSubstr("dispersion is given"));
  EXPECT_THAT(faults_of("{dispersion: {kind: cauchy, a: 1, b_um2: -1}}"), HasSubstr("must give an index in"));
  // A pole at 555 nm, between the wavelengths where the index is checked: too narrow to be seen there.
  EXPECT_THAT(faults_of("{dispersion: {kind: sellmeier, b: [1.22, 0.001], c_um2: [0.0113, 0.308025]}}"),
              HasSubstr("dispersion.c_um2: must not have a resonance between 380 and 780 nm"));
  EXPECT_THAT(faults_of("{dispersion: {kind: sellmeier, b: [1, 2], c_um2: [0.01]}}"),
              HasSubstr("must have as many numbers as b (2), got 1"));
  EXPECT_THAT(faults_of("{dispersion: {kind: cauchy}}"), HasSubstr("dispersion.a"));
}

}  // namespace
}  // namespace evenglow::tracer

#include "tracer/goniometer/goniometer_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr double kRad = core::kRadPerDeg;

GoniometerSpec spec_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("goniometer: " + yaml, "run.yaml");
  GoniometerSpec spec = read_goniometer(document.root().map("goniometer", ""));
  document.finish();
  return spec;
}

std::string faults_of(const std::string& yaml) {
  try {
    spec_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(GoniometerSpec, DefaultsAreThoseOfThePaper) {
  const GoniometerSpec spec = spec_of("{film: {kind: diffuser}}");
  EXPECT_DOUBLE_EQ(spec.illuminance, 409.15);
  EXPECT_DOUBLE_EQ(spec.filter.k1 + spec.filter.k2, 0.9);
  EXPECT_THAT(spec.filter.angles, SizeIs(3));
  EXPECT_THAT(spec.theta, SizeIs(6));
  EXPECT_DOUBLE_EQ(spec.theta[0], 10.0 * kRad);
  EXPECT_THAT(spec.psi, SizeIs(3));
  EXPECT_DOUBLE_EQ(spec.acceptance, 0.5 * kRad);
  EXPECT_FALSE(spec.data);
}

TEST(GoniometerSpec, ReadsItsKeys) {
  const GoniometerSpec spec = spec_of(
      "{film: {kind: dbef, model: {}}, lamp: {illuminance_lx: 100, sigma_deg: 20}, filter: {k1: 0.8, k2: 0.1, "
      "angles_deg: [15], offset_reflection_deg: -2}, detector: {theta_deg: [5, 25], acceptance_deg: 1}, psi_deg: "
      "[30]}");
  EXPECT_DOUBLE_EQ(spec.sigma, 20.0 * kRad);
  EXPECT_DOUBLE_EQ(spec.offset_reflection, -2.0 * kRad);
  EXPECT_DOUBLE_EQ(spec.offset_transmission, 0.0);
  EXPECT_DOUBLE_EQ(spec.theta[1], 25.0 * kRad);
  EXPECT_TRUE(spec.data);  // the table of the model, for its values without resampling
}

TEST(GoniometerSpec, WrongOnesAreRefused) {
  EXPECT_THAT(faults_of("{lamp: {sigma_deg: 10}}"), HasSubstr("film"));
  EXPECT_THAT(faults_of("{film: {kind: lpp}}"), HasSubstr("specular"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, lamp: {sigma_deg: 86}}"),
              HasSubstr("sigma_deg: must lie in [0, 85]"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, detector: {acceptance_deg: 11}}"), HasSubstr("acceptance_deg"));
}

}  // namespace
}  // namespace evenglow::tracer

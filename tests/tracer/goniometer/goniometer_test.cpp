#include "tracer/goniometer/goniometer.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"
#include "tests/support/films.h"
#include "tests/support/z_test.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::kRad;

GoniometerSpec spec_of(const std::string& text) {
  const core::ConfigDocument document =
      core::ConfigDocument::parse(text, std::string(EVENGLOW_SOURCE_DIR) + "/configs/run.yaml");
  GoniometerSpec spec = read_goniometer(document.root().map("goniometer", "", true));
  document.finish();
  return spec;
}

std::string faults_of(const std::string& text) {
  try {
    spec_of("goniometer: " + text);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

const char* const kDbef = "{kind: dbef, table: data/dbef.csv, hemispherical: data/dbef_hemispherical.csv}";

TEST(Goniometer, LambertianFilmHasTheLuminanceOfItsClosedForm) {
  const GoniometerSpec spec = spec_of(
      "goniometer: {film: {kind: diffuser, lobe: lambertian, transmittance: 0.6, reflectance: 0.3}, lamp: "
      "{illuminance_lx: 1000, sigma_deg: 20}, filter: {k1: 0.8, k2: 0.1}, detector: {theta_deg: [0, 30, 55], "
      "acceptance_deg: 3}}");
  const auto result = measure(spec, {.photons = 400'000, .batches = 20, .seed = 3});
  ASSERT_TRUE(result);
  for (const GoniometerRow& row : result->rows) {
    const double E = 1000.0 * (row.setting.filtered ? 0.45 : 1.0);
    const double share = row.kind == ScatterKind::reflection ? 0.3 : 0.6;
    EXPECT_NEAR(row.film, E * share / core::kPi, 1e-9 * E);
    EXPECT_NEAR(row.hits, row.expected_hits, 5.0 * std::sqrt(row.expected_hits));
  }
  EXPECT_EQ(result->rows.size(), 2u * 3u * 3u * 4u);
}

// Chance of a false alarm 1e-4 for each of the two limits.
TEST(Goniometer, TracedLuminanceIsTheEvaluatedOne) {
  for (const double sigma : {0.0, 35.0}) {
    GoniometerSpec spec = spec_of(std::string("goniometer: {film: ") + kDbef +
                                  ", filter: {k1: 0.85, k2: 0.05, offset_reflection_deg: -1.5}, detector: {theta_deg: "
                                  "[0, 5, 10, 20, 30], acceptance_deg: 2}, psi_deg: [0, 30, 130]}");
    spec.sigma = sigma * kRad;
    const auto result = measure(spec, {.photons = 400'000, .batches = 20, .seed = 5});
    ASSERT_TRUE(result);
    const auto& a = result->agreement;
    ASSERT_GT(a.rows, 60);
    EXPECT_GT(tests::chi_square_tail(a.chi_square, a.rows), 1e-4) << a.chi_square << " / " << a.rows;
    EXPECT_LT(a.largest_z, tests::z_limit(1e-4, static_cast<std::size_t>(a.rows)));
    for (const GoniometerRow& row : result->rows) {
      if (row.expected_hits < 200.0) continue;
      const double binomial = row.film * std::sqrt(1.0 / row.expected_hits);
      EXPECT_NEAR(row.traced.se / binomial, 1.0, 0.8);  // 20 batches: 16 % spread
      ASSERT_TRUE(row.table);
      EXPECT_NEAR(row.film / *row.table, 1.0, 0.2);
    }
  }
}

TEST(Goniometer, TheWrongPolarizationIsNoticed) {
  GoniometerSpec spec = spec_of(std::string("goniometer: {film: ") + kDbef +
                                ", detector: {theta_deg: [5, 10], acceptance_deg: 2}, psi_deg: [20]}");
  const auto straight = measure(spec, {});
  spec.offset_reflection = spec.offset_transmission = 5.0 * kRad;
  const auto turned = measure(spec, {});
  double largest = 0.0;
  for (std::size_t i = 0; i < straight->rows.size(); ++i) {
    largest = std::max(largest, std::abs(turned->rows[i].film / straight->rows[i].film - 1.0));
  }
  EXPECT_GT(largest, 0.1);
}

TEST(Goniometer, NaturalLightIsTheMeanOfCrossedFilters) {
  const GoniometerSpec spec = spec_of(
      std::string("goniometer: {film: ") + kDbef +
      ", filter: {k1: 1, k2: 0, angles_deg: [17, 107]}, lamp: {sigma_deg: 30}, detector: {theta_deg: [5, 40]}}");
  const auto result = measure(spec, {});
  for (std::size_t i = 0; i < result->rows.size(); i += 3) {
    EXPECT_NEAR(result->rows[i].film, result->rows[i + 1].film + result->rows[i + 2].film, 1e-9);
    EXPECT_NEAR(*result->rows[i].table, *result->rows[i + 1].table + *result->rows[i + 2].table, 1e-9);
  }
}

TEST(Goniometer, TurningTheFilmByItsKeyIsTurningItByPsi) {
  const std::string rest = "model: {}}, lamp: {sigma_deg: 25}, detector: {theta_deg: [8, 20]}, psi_deg: ";
  const auto by_key = measure(spec_of("goniometer: {film: {kind: dbef, axis_deg: 40, " + rest + "[15]}"), {});
  const auto plain = measure(spec_of("goniometer: {film: {kind: dbef, " + rest + "[15]}"), {});
  for (std::size_t i = 0; i < plain->rows.size(); ++i) {
    EXPECT_NEAR(by_key->rows[i].film / plain->rows[i].film, 1.0, 1e-9);  // psi alone says where the axis is
  }
}

TEST(Goniometer, SameSeedSameNumbersOnAnyThreads) {
  const GoniometerSpec spec = spec_of(std::string("goniometer: {film: ") + kDbef + ", psi_deg: [0]}");
  const auto one = measure(spec, {.photons = 20'000, .batches = 10, .seed = 9, .threads = 1});
  const auto many = measure(spec, {.photons = 20'000, .batches = 10, .seed = 9, .threads = 4});
  for (std::size_t i = 0; i < one->rows.size(); ++i) {
    EXPECT_EQ(one->rows[i].traced.value, many->rows[i].traced.value);
    EXPECT_EQ(one->rows[i].traced.se, many->rows[i].traced.se);
  }
}

TEST(GoniometerSpec, SaysWhatIsWrong) {
  EXPECT_EQ(faults_of("{film: {kind: dbef, model: {}}}"), "accepted");
  EXPECT_THAT(faults_of("{psi_deg: [0]}"), HasSubstr("goniometer.film"));
  EXPECT_THAT(faults_of("{film: {kind: lpp}}"), HasSubstr("must scatter"));
  EXPECT_THAT(faults_of("{film: {kind: sheet}}"), HasSubstr("sheet"));
  EXPECT_THAT(faults_of("{film: {kind: dbef, model: {p1: 3}}}"), HasSubstr("p1"));
  EXPECT_THAT(faults_of("{film: {kind: dbef, model: {a1_pass_cd_m2: 9000}}}"), HasSubstr("1 - absorption"));
  EXPECT_THAT(faults_of("{film: {kind: dbef, model: {}, table: data/dbef.csv}}"), HasSubstr("beside a model"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, psi_deg: [0, 0]}"), HasSubstr("psi_deg"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, lamp: {sigma_deg: 60}}"), HasSubstr("below 90"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, filter: {k1: 0.2, k2: 0.3}}"), HasSubstr("k2"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, detector: {acceptance_deg: 0}}"), HasSubstr("acceptance_deg"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, measured: {reflection: no.csv}}"), HasSubstr("measured.reflection"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, psi_deg: [0], measured: {reflection: "
                        "data/dbef_reflection_luminance.csv}}"),
              HasSubstr("psi 45"));
  EXPECT_THAT(faults_of("{film: {kind: diffuser}, detectors: {}}"), HasSubstr("detectors"));
}

}  // namespace
}  // namespace evenglow::tracer

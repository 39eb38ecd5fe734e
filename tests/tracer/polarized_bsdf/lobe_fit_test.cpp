#include "tracer/polarized_bsdf/lobe_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/montecarlo/photon_rng.h"
#include "tests/support/films.h"
#include "tracer/polarized_bsdf/lobe_model.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;

LuminanceTable reflection() {
  return LuminanceTable::read(tests::data_file("dbef_reflection_luminance.csv"), ScatterKind::reflection);
}
LuminanceTable transmission() {
  return LuminanceTable::read(tests::data_file("dbef_transmission_luminance.csv"), ScatterKind::transmission);
}

/// The values that configs/data/README.md states.
std::map<std::string, double> stated() {
  std::map<std::string, double> values{
      {"throughput", 0.9}, {"offset_reflection_deg", -1.5}, {"offset_transmission_deg", -4.0}};
  for (const LobeParameter& p : lobe_parameters()) values[std::string(p.key)] = LobeParameters{}.*p.member;
  return values;
}

LuminanceMetrics published(const LuminanceTable& table) {
  std::vector<LuminancePair> pairs;
  for (const LuminanceRow& row : table.rows) pairs.push_back({row.theta, row.measured, row.published});
  return luminance_metrics(pairs);
}

// Rows "simulated columns of the paper" and "model" of the table in configs/data/README.md.
TEST(LuminanceMetrics, AreThoseOfTheDataSet) {
  const LuminanceMetrics r = published(reflection()), t = published(transmission());
  EXPECT_NEAR(100.0 * r.plain, 22.0, 0.05);
  EXPECT_NEAR(100.0 * r.at_ten, 12.9, 0.05);
  EXPECT_NEAR(100.0 * r.to_twenty, 12.9, 0.05);
  EXPECT_NEAR(100.0 * r.weighted, 9.0, 0.05);
  EXPECT_NEAR(100.0 * r.l2, 5.9, 0.05);
  EXPECT_NEAR(100.0 * t.plain, 29.3, 0.05);
  EXPECT_NEAR(100.0 * t.at_ten, 6.9, 0.05);
  EXPECT_NEAR(100.0 * t.to_twenty, 9.9, 0.05);
  EXPECT_NEAR(100.0 * t.weighted, 7.5, 0.05);
  EXPECT_NEAR(100.0 * t.l2, 5.4, 0.05);
}

TEST(LuminanceMetrics, ByHand) {
  const LuminancePair pairs[] = {{10 * kRad, 2.0, 2.2}, {30 * kRad, 1.0, 0.8}};
  const LuminanceMetrics m = luminance_metrics(pairs);
  EXPECT_NEAR(m.plain, std::sqrt((0.01 + 0.04) / 2.0), 1e-12);
  EXPECT_NEAR(m.at_ten, 0.1, 1e-12);
  EXPECT_NEAR(m.to_twenty, 0.1, 1e-12);
  EXPECT_NEAR(m.weighted, std::sqrt((2.0 * 0.01 + 0.04) / 3.0), 1e-12);
  EXPECT_NEAR(m.l2, std::sqrt(0.08 / 5.0), 1e-12);
}

TEST(LuminanceTable, RefusesWhatItCannotRead) {
  const auto read = [](const std::string& row) {
    return LuminanceTable::parse("psi_deg,theta_deg,illumination,measured_cd_m2\n" + row, "t.csv",
                                 ScatterKind::reflection);
  };
  EXPECT_EQ(read("0,10,lpf45,3\n").rows.size(), 1u);
  EXPECT_NEAR(read("0,10,lpf45,3\n").rows[0].filter, 45 * kRad, 1e-12);
  EXPECT_THROW(read(""), core::ConfigError);
  EXPECT_THROW(read("0,10,lpf200,3\n"), core::ConfigError);
  EXPECT_THROW(read("0,95,natural,3\n"), core::ConfigError);
  EXPECT_THROW(read("0,10,natural,-3\n"), core::ConfigError);
  EXPECT_THROW(read("0,10,natural,3\n0,10,natural,4\n"), core::ConfigError);
}

TEST(LobeFit, PaperReproducesTheStatedParametersWithinTheirErrors) {
  const LobeFit fit = fit_lobes(reflection(), transmission(), {});
  ASSERT_TRUE(fit.converged);
  const auto expected = stated();
  double squares = 0.0;
  for (const FittedValue& value : fit.values) {
    const double z = (value.value - expected.at(value.key)) / value.se;
    EXPECT_LT(std::abs(z), 3.0) << value.key;
    squares += z * z;
  }
  EXPECT_EQ(fit.values.size(), 22u);
  EXPECT_LT(std::sqrt(squares / 22.0), 1.0);
  // Wide reflected block light: width and amplitude move together.
  EXPECT_FALSE(fit.remarks.empty());
  EXPECT_LT(fit.reflection.at_ten, 0.029);
  EXPECT_LT(fit.transmission.at_ten, 0.025);
}

TEST(LobeFit, KeepsTheEnergyConstraint) {
  LobeFitOptions options;
  options.absorption = 0.03;
  const LobeModel model(fit_lobes(reflection(), transmission(), options).parameters);
  for (const FilmLight light : {FilmLight::pass, FilmLight::block}) {
    EXPECT_NEAR(model.unscaled(ScatterKind::reflection, light) + model.unscaled(ScatterKind::transmission, light), 0.97,
                1e-9);
  }
}

/// The tables with the model's luminances, times 1 + noise of the given relative size.
LuminanceTable synthetic(LuminanceTable table, const LobeParameters& p, const LuminanceSetup& setup, double noise,
                         core::PhotonRng& rng) {
  for (LuminanceRow& row : table.rows) {
    const double normal = std::sqrt(-2.0 * std::log(rng.uniform())) * std::cos(2.0 * core::kPi * rng.uniform());
    row.measured = lobe_luminance(p, setup, table.kind, row) * (1.0 + noise * normal);
  }
  return table;
}

/// A film that keeps the constraint: that of the paper's fit.
LobeFit truth() {
  return fit_lobes(reflection(), transmission(), {});
}

TEST(LobeFit, FindsTheParametersOfPerfectReadings) {
  const LobeFit expected = truth();
  core::PhotonRng rng({1, 0, 0}, 0);
  LobeFitOptions options;
  options.loss_width = 0.0;
  const LobeFit fit = fit_lobes(synthetic(reflection(), expected.parameters, expected.setup, 0.0, rng),
                                synthetic(transmission(), expected.parameters, expected.setup, 0.0, rng), options);
  EXPECT_LT(fit.chi_square, 1e-9);
  for (std::size_t i = 0; i < fit.values.size(); ++i) {
    EXPECT_NEAR(fit.values[i].value / expected.values[i].value, 1.0, 1e-3) << fit.values[i].key;
  }
}

// 48 sets of readings with errors of 1 %, 22 values each. The pulls of one set hang together, so the spread of their
// mean square is taken from set to set. Errors linearized about the solution may be a twentieth off (240 sets gave 1.06
// +- 0.04). False alarm 1e-5 for each of the two.
TEST(LobeFit, ErrorsAreTrue) {
  const LobeFit expected = truth();
  for (const double loss : {0.0, 1.0}) {
    LobeFitOptions options;
    options.relative_error = 0.01;
    options.absolute_error = 0.0;
    options.loss_width = loss;
    options.start = expected.parameters;
    double sum = 0.0, squares = 0.0;
    constexpr int kSets = 48;
    for (std::uint64_t set = 0; set < kSets; ++set) {
      core::PhotonRng rng({11, 0, 0}, set);
      const LuminanceTable r = synthetic(reflection(), expected.parameters, expected.setup, 0.01, rng);
      const LuminanceTable t = synthetic(transmission(), expected.parameters, expected.setup, 0.01, rng);
      const LobeFit fit = fit_lobes(r, t, options);
      double mean = 0.0;
      for (std::size_t i = 0; i < fit.values.size(); ++i) {
        mean += std::pow((fit.values[i].value - expected.values[i].value) / fit.values[i].se, 2);
      }
      mean /= static_cast<double>(fit.values.size());
      sum += mean;
      squares += mean * mean;
    }
    const double mean = sum / kSets;
    const double se = std::sqrt((squares / kSets - mean * mean) / (kSets - 1));
    EXPECT_LT(mean, 1.1 + 4.3 * se) << "loss " << loss;
    EXPECT_GT(mean, 0.9 - 4.3 * se) << "loss " << loss;
  }
}

TEST(LobeFit, SaysWhatTheReadingsDoNotTell) {
  const auto natural = [](LuminanceTable table) {
    std::erase_if(table.rows, [](const LuminanceRow& row) { return row.filtered; });
    return table;
  };
  const LobeFit fit = fit_lobes(natural(reflection()), natural(transmission()), {});
  EXPECT_FALSE(fit.remarks.empty());
  for (const FittedValue& value : fit.values) {
    if (value.key != "throughput" && !value.key.starts_with("offset")) continue;
    EXPECT_TRUE(std::isinf(value.se)) << value.key;
  }
}

TEST(LobeFit, HoldsTheThroughput) {
  LobeFitOptions options;
  options.throughput = 0.85;
  const LobeFit fit = fit_lobes(reflection(), transmission(), options);
  EXPECT_DOUBLE_EQ(fit.setup.throughput, 0.85);
  EXPECT_EQ(fit.degrees_of_freedom, 144 - 19);
  for (const FittedValue& value : fit.values) EXPECT_EQ(value.se == 0.0, value.key == "throughput") << value.key;
  for (const std::string& remark : fit.remarks) EXPECT_EQ(remark.find("throughput"), std::string::npos) << remark;
}

TEST(LobeFit, RefusesTooFewReadings) {
  LuminanceTable few = reflection(), none = transmission();
  few.rows.resize(15);
  none.rows.clear();
  EXPECT_THROW(fit_lobes(few, none, {}), core::Error);
}

TEST(LobeFit, HeldOutReadingsArePredictedWorseThanFittedOnes) {
  const CrossValidation cv = cross_validate(reflection(), transmission(), {}, 12);
  const LobeFit fit = fit_lobes(reflection(), transmission(), {});
  EXPECT_EQ(cv.reflection.pairs + cv.transmission.pairs, 144);
  EXPECT_GT(cv.chi_square, fit.chi_square / 144.0);
  EXPECT_LT(cv.chi_square, 2.0 * fit.chi_square / 144.0);
}

}  // namespace
}  // namespace evenglow::tracer

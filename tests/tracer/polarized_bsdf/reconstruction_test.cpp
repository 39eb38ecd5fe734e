#include "tracer/polarized_bsdf/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"
#include "tests/support/synthetic_film.h"
#include "tracer/polarized_bsdf/mueller_check.h"
#include "tracer/polarized_bsdf/reconstruction_writer.h"
#include "tracer/polarized_bsdf/table_check.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::Pulls;

constexpr double kDeg = core::kRadPerDeg;
constexpr const char* kUnits = "# degrees, nm, 1/sr\n";
constexpr const char* kNode = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm";

struct TextOptions {
  double noise = 0.0;  ///< share of the mean reading of a node
  bool errors = true;
  bool laboratory = false;
  double k1 = 1.0, k2 = 0.0;
  bool missing = false;  ///< one of four is empty, each in turn
};

/// Readings at four angles of every node of the data file.
std::string readings_of(const BsdfTable& table, const TextOptions& o) {
  std::mt19937_64 rng(41);
  std::normal_distribution<double> normal;
  std::string text = std::string(kUnits) + kNode + ",b0,b45,b90,b135" + (o.errors ? ",se\n" : "\n");
  const auto& a = table.axes();
  const double contrast = (o.k1 - o.k2) / (o.k1 + o.k2);
  std::size_t row = 0;
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 0; t < a.theta.size(); ++t, ++row) {
            const BsdfTable::Node& n = table.node(kind, p, s, f, t, 0);
            const double se = o.noise * 0.5 * (n.tau_min + n.tau_max);
            text += fmt::format("{},{:.0f},{:.0f},{:.0f},{:.0f},550", kind == ScatterKind::reflection ? "BRDF" : "BTDF",
                                a.psi[p] / kDeg, a.sigma[s] / kDeg, a.phi[f] / kDeg, a.theta[t] / kDeg);
            const double origin = o.laboratory ? a.psi[p] : 0.0;
            const auto B =
                tests::angle_readings(n.tau_min, n.tau_max, n.delta + origin, tests::four_angles(), contrast);
            for (std::size_t k = 0; k < 4; ++k) {
              const double value = B[k].value + se * normal(rng);
              text += o.missing && row % 4 == k ? std::string(",") : fmt::format(",{}", value);
            }
            text += o.errors ? fmt::format(",{}\n", std::max(se, 1e-9)) : std::string("\n");
          }
        }
      }
    }
  }
  return text;
}

const BsdfTable& data_table() {
  static const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  return table;
}

void expect_same(const BsdfTable& found, const BsdfTable& expected, double tolerance) {
  const auto& a = expected.axes();
  ASSERT_EQ(found.axes().theta, a.theta);
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 0; t < a.theta.size(); ++t) {
            const BsdfTable::Node& x = found.node(kind, p, s, f, t, 0);
            const BsdfTable::Node& y = expected.node(kind, p, s, f, t, 0);
            ASSERT_NEAR(x.tau_min, y.tau_min, tolerance * y.tau_max);
            ASSERT_NEAR(x.tau_max, y.tau_max, tolerance * y.tau_max);
            ASSERT_NEAR(half_turn(x.delta - y.delta), 0.0, 1e-9);
          }
        }
      }
    }
  }
}

BsdfTable through_files(const std::string& readings, const ReconstructionOptions& options) {
  return BsdfTable::parse(table_text(reconstruct(FilmReadings::parse(readings, "r.csv"), options)), "t.csv");
}

TEST(Reconstruction, WholeTableComesBackFromFourReadings) {
  expect_same(through_files(readings_of(data_table(), {}), {}), data_table(), 3e-12);
}

TEST(Reconstruction, WholeTableComesBackFromThreeReadings) {
  TextOptions text;
  text.missing = true;
  expect_same(through_files(readings_of(data_table(), text), {}), data_table(), 3e-12);
}

TEST(Reconstruction, AnglesCountedInTheLaboratory) {
  TextOptions text;
  text.laboratory = true;
  const std::string readings = readings_of(data_table(), text);
  ReconstructionOptions options;
  options.angles = AngleOrigin::laboratory;
  expect_same(through_files(readings, options), data_table(), 3e-12);
  const BsdfTable wrong = through_files(readings, {});
  EXPECT_GT(std::abs(half_turn(wrong.node(ScatterKind::reflection, 1, 0, 0, 0, 0).delta)), 0.7) << "off by psi = 45";
}

TEST(Reconstruction, RealPolarizerIsDividedOut) {
  TextOptions text;
  text.k1 = 0.86;
  text.k2 = 0.04;
  ReconstructionOptions options;
  options.polarizer = {0.86, 0.04};
  expect_same(through_files(readings_of(data_table(), text), options), data_table(), 3e-12);
}

TEST(Reconstruction, ErrorsComeFromRedundantReadingsWhereNoneAreGiven) {
  TextOptions text;
  text.noise = 0.02;
  text.errors = false;
  const Reconstruction result = reconstruct(FilmReadings::parse(readings_of(data_table(), text), "r.csv"), {});
  ASSERT_TRUE(result.estimated_error.has_value());
  ASSERT_TRUE(result.has_errors);
  // Noise was a share of the mean reading, the estimate is one of the root mean square, which is larger by up to sqrt
  // 1.5 for a polarizing film; 6528 redundant readings give 0.9 %.
  EXPECT_GT(*result.estimated_error, 0.02 / std::sqrt(1.5) * 0.97);
  EXPECT_LT(*result.estimated_error, 0.02 * 1.03);
}

TEST(Reconstruction, WithoutErrorsAndRedundancyTheTableHasNone) {
  TextOptions text;
  text.errors = false;
  text.missing = true;
  const Reconstruction result = reconstruct(FilmReadings::parse(readings_of(data_table(), text), "r.csv"), {});
  EXPECT_FALSE(result.has_errors);
  EXPECT_THAT(table_text(result), testing::Not(HasSubstr("tau_min_se")));
}

/// General readings of one node: every pair of 0, 45, 90, 135 degrees, right, left, none. V as a physicist counts it:
/// right circular is +1 in the right-handed frame of each ray.
std::string general_rows(const core::MuellerMatrix& film, const char* kind, double psi_deg, double lambda) {
  struct State {
    const char* kind;
    const char* angle;
    Eigen::Vector4d s;
  };
  const std::vector<State> states{{"none", "", {1, 0, 0, 0}},       {"linear", "0", {1, 1, 0, 0}},
                                  {"linear", "45", {1, 0, 1, 0}},   {"linear", "90", {1, -1, 0, 0}},
                                  {"linear", "135", {1, 0, -1, 0}}, {"right", "", {1, 0, 0, 1}},
                                  {"left", "", {1, 0, 0, -1}}};
  const bool up = std::string(kind) == "BRDF";
  std::string text;
  for (const State& in : states) {
    for (const State& out : states) {
      // Into the tangential count: V changes sign where the ray travels down. (Angles are counted in it already.)
      const Eigen::Vector4d s(in.s[0], in.s[1], in.s[2], -in.s[3]);
      const double share = std::string(out.kind) == "none" ? 1.0 : 0.5;
      const Eigen::Vector4d a(out.s[0], out.s[1], out.s[2], up ? out.s[3] : -out.s[3]);
      text += fmt::format("{},{},0,0,0,{},{},{},{},{},{},0.001\n", kind, psi_deg, lambda, in.kind, in.angle, out.kind,
                          out.angle, share * a.dot(film * s));
    }
  }
  return text;
}

std::string general_text(const std::string& rows) {
  return std::string(kUnits) + kNode + ",in_kind,in_angle_deg,out_kind,out_angle_deg,value,se\n" + rows;
}

TEST(Reconstruction, GeneralReadingsGiveTheMatrixAndTheTable) {
  std::string rows;
  const auto film = [](double lambda, double psi) -> core::MuellerMatrix {
    return core::rotator(0.1 - psi * kDeg) * core::diattenuator(0.4, lambda / 100.0, 0.8) *
           core::rotator(psi * kDeg + 0.2);
  };
  for (const double lambda : {450.0, 550.0, 650.0}) {
    for (const double psi : {0.0, 90.0}) {
      for (const char* kind : {"BRDF", "BTDF"}) rows += general_rows(film(lambda, psi), kind, psi, lambda);
    }
  }
  ReconstructionOptions options;
  options.angles = AngleOrigin::laboratory;
  const Reconstruction result = reconstruct(FilmReadings::parse(general_text(rows), "r.csv"), options);
  ASSERT_EQ(result.nodes.size(), 12u);
  for (const NodeResult& node : result.nodes) {
    EXPECT_LT((node.mueller->M - film(node.node.lambda_nm, node.node.psi_deg)).norm(), 1e-12 * node.node.lambda_nm);
    EXPECT_NEAR(node.kappa, 0.8, 1e-10);
    EXPECT_LT(node.rest, 1e-10);
  }
  const BsdfTable table = BsdfTable::parse(table_text(result), "t.csv");
  EXPECT_EQ(table.axes().lambda_nm.size(), 3u);
  const BsdfTable::Node& node = table.node(ScatterKind::transmission, 1, 0, 0, 0, 2);
  EXPECT_NEAR(node.tau_min, 0.4, 1e-10);
  EXPECT_NEAR(node.tau_max, 6.5, 1e-10);
  EXPECT_NEAR(node.delta, 0.2, 1e-9);
  EXPECT_NEAR(node.kappa, 0.8, 1e-9);
  EXPECT_GT(node.tau_max_se, 0.0);
  EXPECT_TRUE(mueller_faults(mueller_text(result), "m.csv").empty());
  EXPECT_THAT(covariance_text(result), HasSubstr(",c_33_33\n"));
}

TEST(Reconstruction, AMirrorTurnsRightIntoLeft) {
  // Tangential count: an ideal mirror is the unit matrix. Physical readings: what goes in right comes back left.
  const std::string rows = general_rows(core::MuellerMatrix::Identity(), "BRDF", 0, 550);
  EXPECT_THAT(rows, HasSubstr("right,,right,,0,"));
  EXPECT_THAT(rows, HasSubstr("right,,left,,1,"));
  const Reconstruction result = reconstruct(FilmReadings::parse(general_text(rows), "r.csv"), {});
  EXPECT_LT((result.nodes[0].mueller->M - core::MuellerMatrix::Identity()).norm(), 1e-12);
  EXPECT_LT(result.nodes[0].contradiction(), 1e-6);
}

TEST(Reconstruction, RealPolarizersInBothChannelsAreDividedOut) {
  const core::MuellerMatrix M = core::rotator(-0.2) * core::diattenuator(0.3, 1.1, 0.9) * core::rotator(0.4);
  const PrincipalTransmittances first{0.8, 0.1}, second{0.9, 0.02};
  ReadingGroup group;
  group.node.kind = ScatterKind::reflection;
  ReconstructionOptions options;
  options.polarizer = first;
  options.analyzer = second;
  for (const PolarizerKind in : {PolarizerKind::linear, PolarizerKind::right, PolarizerKind::left}) {
    for (const PolarizerKind out : {PolarizerKind::linear, PolarizerKind::right, PolarizerKind::left}) {
      for (int i = 0; i < 9; ++i) group.readings.push_back({in, out, (i % 3) * 1.0, (i / 3) * 1.0, 0.0, 1.0, 1});
    }
  }
  auto readings = mueller_readings(group, options);
  const double p = 0.7 / 0.9;
  EXPECT_NEAR(readings[0].in[1], p, 1e-12);
  EXPECT_NEAR(readings[0].out[0], 0.46, 1e-12);
  EXPECT_NEAR(readings[0].out[1], 0.44, 1e-12);
  for (MuellerReading& r : readings) r.value = r.out.dot(M * r.in);
  EXPECT_LT((fit_mueller(readings).M - M).norm(), 1e-12);
}

std::string fault_of(const std::string& text) {
  try {
    reconstruct(FilmReadings::parse(text, "r.csv"), {});
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Reconstruction, RefusesWhatCannotBeReconstructed) {
  const std::string header = std::string(kUnits) + kNode + ",b0,b45,b90,b135\n";
  EXPECT_THAT(fault_of(header + "BRDF,0,0,0,0,550,1,,2,\n"),
              HasSubstr("r.csv:3:18: b0: at most one of b0, b45, b90, b135 may be empty, got 2"));
  EXPECT_THAT(fault_of(header + "BRDF,0,0,0,0,550,1,2,nan,1\n"), HasSubstr("r.csv:3:22: b90: must be a number"));
  EXPECT_THAT(fault_of(std::string(kUnits) + kNode + ",b0,b45,b90,b135,se\nBRDF,0,0,0,0,550,1,2,3,2,0\n"),
              HasSubstr("se: must be a number in (0, 1e12], got '0'"));
  EXPECT_THAT(fault_of("# radians\n" + std::string(kNode) + ",b0,b45,b90,b135\nBRDF,0,0,0,0,550,1,2,3,2\n"),
              HasSubstr("r.csv:1:1: the comment must name the units degrees, nm and 1/sr, got 'radians'"));
  std::string rows = general_rows(core::MuellerMatrix::Identity(), "BRDF", 0, 550);
  std::string without;
  for (std::size_t at = 0; at < rows.size();) {
    const std::string line = rows.substr(at, rows.find('\n', at) + 1 - at);
    at += line.size();
    if (line.find(",right,,l") == std::string::npos && line.find("left,,") == std::string::npos &&
        line.find("right,,") == std::string::npos) {
      without += line;
    }
  }
  EXPECT_THAT(
      fault_of(general_text(without)),
      HasSubstr("r.csv:3:1: must have readings that determine all 16 entries of the Mueller matrix, got 25 that "
                "determine 9 for BRDF psi 0 sigma 0 phi 0 theta 0 lambda 550 (independent polarizations: "
                "illumination 3 of 4, observation 3 of 4)"));
  EXPECT_THAT(fault_of(general_text("BRDF,0,0,0,0,550,linear,,none,,1,0.1\n")),
              HasSubstr("in_angle_deg: must be a number in [-360, 360] for a linear polarizer, got ''"));
  EXPECT_THAT(fault_of(general_text("BRDF,0,0,0,0,550,elliptic,1,none,,1,0.1\n")), HasSubstr("in_kind: must be none"));
}

TEST(Reconstruction, SeparateErrorsAndRepeatedRowsAreTakenTogether) {
  const std::string text = std::string(kUnits) + kNode +
                           ",b0,b45,b90,b135,se0,se45,se90,se135\n"
                           "BRDF,0,0,0,0,550,1,2,3,2,0.1,0.2,0.3,0.4\n"
                           "BRDF,0,0,0,0,550,1,,3,2,0.1,,0.3,0.4\n";
  const FilmReadings readings = FilmReadings::parse(text, "r.csv");
  ASSERT_EQ(readings.groups().size(), 1u);
  ASSERT_EQ(readings.groups()[0].readings.size(), 7u);
  EXPECT_EQ(readings.groups()[0].readings[5].se, 0.3);
  EXPECT_EQ(readings.groups()[0].readings[5].line, 4);
  EXPECT_EQ(reconstruct(readings, {}).nodes[0].degrees_of_freedom, 4);
}

}  // namespace
}  // namespace evenglow::tracer

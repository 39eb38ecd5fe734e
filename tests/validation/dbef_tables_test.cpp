#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/films.h"

/// The published luminance tables of a DBEF sample behind a virtual goniometer at normal incidence, from the
/// interpolated BSDF table; figures and set-up as configs/data/README.md states. The table was fitted to these
/// measurements: the test holds the reading and the interpolation, not the model's foresight.
namespace evenglow::tracer {
namespace {

using tests::kRad;

constexpr double kIlluminance = 409.15;  // lx
constexpr double kThroughput = 0.900;    // k1 + k2 of the filter

struct Metrics {
  double plain = 0.0, at_ten = 0.0, l2 = 0.0;  // percent
  int rows = 0;
};

Metrics compare(const std::string& file, ScatterKind kind, double offset) {
  const BsdfTable table = BsdfTable::read(tests::data_file("dbef.csv"));
  std::ifstream stream(tests::data_file(file));
  std::string line;
  std::getline(stream, line);
  double squares = 0.0, ten_squares = 0.0, differences = 0.0, total = 0.0;
  int ten = 0;
  Metrics m;
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    double psi = 0, theta = 0, measured = 0;
    std::string filter;
    fields >> psi >> theta >> filter >> measured;
    const BsdfTable::Value v = table.at(kind, psi * kRad, 0.0, 0.0, theta * kRad, 550.0);
    double simulated = 0.5 * kIlluminance * v.S;
    if (filter != "natural") {
      const double turn = 2.0 * (std::stod(filter.substr(3)) - psi - offset) * kRad;
      simulated = 0.25 * kThroughput * kIlluminance * v.S * (1.0 - v.x * std::cos(turn) - v.y * std::sin(turn));
    }
    const double relative = (simulated - measured) / measured;
    squares += relative * relative;
    differences += (simulated - measured) * (simulated - measured);
    total += measured * measured;
    ++m.rows;
    if (theta == 10.0) {
      ten_squares += relative * relative;
      ++ten;
    }
  }
  m.plain = 100.0 * std::sqrt(squares / m.rows);
  m.at_ten = 100.0 * std::sqrt(ten_squares / ten);
  m.l2 = 100.0 * std::sqrt(differences / total);
  return m;
}

TEST(DbefTables, Reflection) {
  const Metrics m = compare("dbef_reflection_luminance.csv", ScatterKind::reflection, -1.5);
  EXPECT_EQ(m.rows, 72);
  EXPECT_NEAR(m.plain, 15.8, 0.1);
  EXPECT_NEAR(m.at_ten, 2.8, 0.1);
  EXPECT_NEAR(m.l2, 3.4, 0.1);
}

TEST(DbefTables, Transmission) {
  const Metrics m = compare("dbef_transmission_luminance.csv", ScatterKind::transmission, -4.0);
  EXPECT_EQ(m.rows, 72);
  EXPECT_NEAR(m.plain, 27.8, 0.1);
  EXPECT_NEAR(m.at_ten, 2.2, 0.1);
  EXPECT_NEAR(m.l2, 2.1, 0.1);
}

}  // namespace
}  // namespace evenglow::tracer

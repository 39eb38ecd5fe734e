#include "tracer/sources/intensity_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/csv_numbers.h"
#include "core/config/message_text.h"

namespace evenglow::tracer {
namespace {

enum Columns : std::size_t { kTheta, kPhi, kIntensity, kCandela };
constexpr std::size_t kMaxRows = 1000000;

[[noreturn]] void refuse(const core::CsvNumbers& csv, int line, const std::string& message) {
  throw core::ConfigError(core::Fault{core::one_line(csv.name()), line, 0, "", message});
}

core::CsvNumbers read_columns(const std::filesystem::path& file) {
  constexpr double kMax = 1e12;
  const std::array<core::CsvColumn, 4> columns{{{"theta_deg", "a number in [0, 180]", 0, 180},
                                                {"phi_deg", "a number in [0, 360]", 0, 360, false, false},
                                                {"intensity", "a number in [0, 1e12]", 0, kMax, false, false},
                                                {"intensity_cd", "a number in [0, 1e12]", 0, kMax, false, false}}};
  core::CsvNumbers csv = core::CsvNumbers::read(file, columns);
  if (csv.has(kIntensity) == csv.has(kCandela)) {
    refuse(csv, 0,
           fmt::format("must have either a column intensity or intensity_cd, got {}",
                       csv.has(kIntensity) ? "both" : "none"));
  }
  if (csv.rows() > kMaxRows)
    refuse(csv, 0, fmt::format("must not hold more than {} rows, got {}", kMaxRows, csv.rows()));
  return csv;
}

std::vector<double> nodes(const core::CsvNumbers& csv, std::size_t column) {
  if (!csv.has(column)) return {0.0};
  std::vector<double> result;
  for (std::size_t row = 0; row < csv.rows(); ++row) result.push_back(csv.value(row, column));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::size_t index_of(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

/// The intensities on the full grid of the nodes.
std::vector<double> on_grid(const core::CsvNumbers& csv, const std::vector<double>& theta,
                            const std::vector<double>& phi) {
  if (csv.rows() < theta.size() * phi.size()) {
    refuse(csv, 0,
           fmt::format("must hold every theta_deg ({}) with every phi_deg ({}), {} rows, got {}", theta.size(),
                       phi.size(), theta.size() * phi.size(), csv.rows()));
  }
  std::vector<double> values(theta.size() * phi.size(), std::numeric_limits<double>::quiet_NaN());
  const std::size_t column = csv.has(kCandela) ? kCandela : kIntensity;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double t = csv.value(row, kTheta);
    const double p = csv.has(kPhi) ? csv.value(row, kPhi) : 0.0;
    double& value = values[index_of(phi, p) * theta.size() + index_of(theta, t)];
    if (!std::isnan(value)) {
      refuse(csv, csv.line(row), fmt::format("must not give theta_deg {}, phi_deg {} twice", t, p));
    }
    value = csv.value(row, column);
  }
  return values;
}

}  // namespace

IntensityCsv read_intensity_csv(const std::filesystem::path& file) {
  const core::CsvNumbers csv = read_columns(file);
  std::vector<double> theta = nodes(csv, kTheta);
  std::vector<double> phi = nodes(csv, kPhi);
  if (theta.size() < 2) refuse(csv, 0, "must hold two values of theta_deg at least");
  const std::vector<double> values = on_grid(csv, theta, phi);
  AzimuthSymmetry symmetry{};
  try {
    symmetry = symmetry_of_range(phi.front(), phi.back());
  } catch (const core::Error& error) {
    refuse(csv, 0, fmt::format("phi_deg: {}", error.what()));
  }
  for (double& angle : theta) angle *= core::kRadPerDeg;
  for (double& angle : phi) angle *= core::kRadPerDeg;
  return {whole_circle(std::move(theta), phi, values, symmetry), csv.has(kCandela)};
}

}  // namespace evenglow::tracer

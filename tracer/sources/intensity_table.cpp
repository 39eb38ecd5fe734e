#include "tracer/sources/intensity_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

using core::kPi;

/// Adds the column of a file's azimuth `from` to the table at azimuth `phi`, unless the last one stands there already.
void add_column(IntensityTable& table, double phi, const std::vector<double>& values, std::size_t from) {
  constexpr double kSame = 1e-9;
  if (!table.phi.empty() && phi <= table.phi.back() + kSame) return;
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from * table.theta.size());
  table.phi.push_back(phi);
  table.values.insert(table.values.end(), begin, begin + static_cast<std::ptrdiff_t>(table.theta.size()));
}

/// A column of the whole circle: its azimuth, and which of the file it is.
struct Column {
  double phi = 0.0;
  std::size_t from = 0;
};

/// Adds the mirror images beyond the plane whose azimuth is `plane`.
void mirror(std::vector<Column>& columns, double plane) {
  const std::size_t count = columns.size();
  for (std::size_t i = 0; i < count; ++i) columns.push_back({2.0 * plane - columns[i].phi, columns[i].from});
}

void into_circle(std::vector<Column>& columns) {
  constexpr double kSlack = 1e-9;
  const std::size_t count = columns.size();
  for (std::size_t i = 0; i < count; ++i) {
    double& phi = columns[i].phi;
    if (phi < -kSlack) phi += 2.0 * kPi;
    if (std::abs(phi) <= kSlack) {
      phi = 0.0;
      columns.push_back({2.0 * kPi, columns[i].from});
    }
  }
  std::stable_sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.phi < b.phi; });
}

/// Closes a circle whose azimuths begin after 0: the column at 0 and 2 pi lies between the last and the first.
void close(IntensityTable& table) {
  const std::size_t n = table.theta.size();
  const double before = 2.0 * kPi - table.phi.back();
  const double share = before / (before + table.phi.front());
  std::vector<double> seam;
  for (std::size_t j = 0; j < n; ++j) {
    seam.push_back((1.0 - share) * table.at(table.phi.size() - 1, j) + share * table.at(0, j));
  }
  table.phi.insert(table.phi.begin(), 0.0);
  table.phi.push_back(2.0 * kPi);
  table.values.insert(table.values.begin(), seam.begin(), seam.end());
  table.values.insert(table.values.end(), seam.begin(), seam.end());
}

/// Index and share of the way to the next node.
std::pair<std::size_t, double> between(const std::vector<double>& nodes, double at) {
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), at);
  const auto i = std::clamp<std::ptrdiff_t>(next - nodes.begin() - 1, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 2);
  const auto k = static_cast<std::size_t>(i);
  return {k, (at - nodes[k]) / (nodes[k + 1] - nodes[k])};
}

}  // namespace

AzimuthSymmetry symmetry_of_range(double first, double last) {
  if (first == 0.0) {
    if (last == 0.0) return AzimuthSymmetry::kRotation;
    if (last == 90.0) return AzimuthSymmetry::kQuadrant0To90;
    if (last == 180.0) return AzimuthSymmetry::kPlane0To180;
    if (last == 360.0) return AzimuthSymmetry::kNone;
  }
  if (first == 90.0 && last == 270.0) return AzimuthSymmetry::kPlane90To270;
  throw core::Error(
      fmt::format("must be 0 alone or run from 0 to 90, 180 or 360, or from 90 to 270, got {} to {}", first, last));
}

double IntensityTable::intensity(double theta_at, double phi_at) const {
  if (theta_at < theta.front() || theta_at > theta.back()) return 0.0;
  const auto [j, v] = between(theta, theta_at);
  const auto [i, u] = between(phi, phi_at);
  return (1.0 - u) * ((1.0 - v) * at(i, j) + v * at(i, j + 1)) + u * ((1.0 - v) * at(i + 1, j) + v * at(i + 1, j + 1));
}

IntensityTable whole_circle(std::vector<double> theta, const std::vector<double>& phi,
                            const std::vector<double>& values, AzimuthSymmetry symmetry) {
  core::expects(!phi.empty() && values.size() == phi.size() * theta.size(), "a value for each node of the table");
  std::vector<Column> columns;
  for (std::size_t i = 0; i < phi.size(); ++i) columns.push_back({phi[i], i});
  if (symmetry == AzimuthSymmetry::kRotation) columns = {{0.0, 0}, {2.0 * kPi, 0}};
  if (symmetry == AzimuthSymmetry::kQuadrant0To90) mirror(columns, 0.5 * kPi);
  if (symmetry == AzimuthSymmetry::kQuadrant0To90 || symmetry == AzimuthSymmetry::kPlane0To180) mirror(columns, kPi);
  if (symmetry == AzimuthSymmetry::kPlane90To270) mirror(columns, 0.5 * kPi);
  into_circle(columns);
  IntensityTable table;
  table.theta = std::move(theta);
  for (const Column& column : columns) add_column(table, column.phi, values, column.from);
  if (table.phi.front() > 0.0) close(table);
  return table;
}

IntensityTable front_hemisphere(const IntensityTable& table) {
  constexpr double kSlack = 1e-9;
  IntensityTable front;
  front.phi = table.phi;
  for (const double theta : table.theta) {
    if (theta < 0.5 * kPi - kSlack) front.theta.push_back(theta);
  }
  const std::size_t whole = front.theta.size();
  if (whole == 0) return front;
  const bool edge = whole < table.theta.size();
  if (edge) front.theta.push_back(0.5 * kPi);
  for (std::size_t i = 0; i < table.phi.size(); ++i) {
    for (std::size_t j = 0; j < whole; ++j) front.values.push_back(table.at(i, j));
    if (edge) front.values.push_back(table.intensity(0.5 * kPi, table.phi[i]));
  }
  return front;
}

double cell_flux(const IntensityTable& table, std::size_t i, std::size_t j) {
  // The mean over phi is linear in theta: I = a + b (theta - t0). With primitives about t0,
  // int sin = cos t0 - cos t1 and int (t - t0) sin t = sin t1 - sin t0 - (t1 - t0) cos t1.
  const double t0 = table.theta[j];
  const double t1 = table.theta[j + 1];
  const double a = 0.5 * (table.at(i, j) + table.at(i + 1, j));
  const double b = (0.5 * (table.at(i, j + 1) + table.at(i + 1, j + 1)) - a) / (t1 - t0);
  const double constant = 2.0 * std::sin(0.5 * (t0 + t1)) * std::sin(0.5 * (t1 - t0));
  const double linear = 2.0 * std::cos(0.5 * (t0 + t1)) * std::sin(0.5 * (t1 - t0)) - (t1 - t0) * std::cos(t1);
  return std::max(0.0, (table.phi[i + 1] - table.phi[i]) * (a * constant + b * linear));
}

double total_flux(const IntensityTable& table) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < table.phi.size(); ++i) {
    for (std::size_t j = 0; j + 1 < table.theta.size(); ++j) sum += cell_flux(table, i, j);
  }
  return sum;
}

}  // namespace evenglow::tracer

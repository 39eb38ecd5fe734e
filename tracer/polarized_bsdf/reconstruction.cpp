#include "tracer/polarized_bsdf/reconstruction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr std::size_t kMaxFaults = 10;
/// Redundant readings that an estimate of their error takes at least: it is then good to about 1 / sqrt(2 x 10) = 22 %.
constexpr int kLeastRedundant = 10;

std::vector<AngleReading> angle_readings(const ReadingGroup& group) {
  std::vector<AngleReading> readings;
  readings.reserve(group.readings.size());
  for (const FilmReading& r : group.readings) readings.push_back({r.in_angle, r.value, r.se > 0.0 ? r.se : 1.0});
  return readings;
}

double mean_square(const ReadingGroup& group) {
  double sum = 0.0;
  for (const FilmReading& r : group.readings) sum += r.value * r.value;
  return sum / static_cast<double>(group.readings.size());
}

/// Error of the readings over their root mean square, common to all nodes.
std::optional<double> estimated_error(const FilmReadings& readings) {
  double sum = 0.0;
  int degrees = 0;
  for (const ReadingGroup& group : readings.groups()) {
    const double square = mean_square(group);
    if (square == 0.0) continue;
    const FirstRow row = fit_first_row(angle_readings(group));
    sum += row.chi_square / square;
    degrees += row.degrees_of_freedom;
  }
  if (degrees < kLeastRedundant) return std::nullopt;
  return std::sqrt(sum / degrees);
}

/// Standard normal variable of about the same probability as chi-square (Wilson & Hilferty, PNAS 17, 1931).
double normal_score(double chi_square, int degrees) {
  const double spread = 2.0 / (9.0 * degrees);
  return (std::cbrt(chi_square / degrees) - (1.0 - spread)) / std::sqrt(spread);
}

void remove_psi(DiattenuatorValues& values, const FilmNode& node, AngleOrigin origin) {
  if (origin == AngleOrigin::film) return;
  values.delta = half_turn(values.delta - node.psi_deg * core::kRadPerDeg);
}

NodeResult from_angles(const ReadingGroup& group, const ReconstructionOptions& options, const Reconstruction& whole) {
  NodeResult result;
  FirstRow row = fit_first_row(angle_readings(group), options.polarizer.contrast());
  if (!whole.has_errors) row.covariance.setZero();
  if (whole.estimated_error) {
    const double variance = std::pow(*whole.estimated_error, 2) * mean_square(group);
    row.covariance *= variance;
    row.chi_square = variance > 0.0 ? row.chi_square / variance : 0.0;
  }
  result.values = diattenuator_values(row, options.bias);
  result.chi_square = whole.has_errors ? row.chi_square : 0.0;
  result.degrees_of_freedom = whole.has_errors ? row.degrees_of_freedom : 0;
  return result;
}

NodeResult from_both_channels(const ReadingGroup& group, const ReconstructionOptions& options) {
  NodeResult result;
  MuellerFit fit = fit_mueller(mueller_readings(group, options));
  const TableForm form = table_form(fit.M, fit.covariance);
  result.values = diattenuator_values(form.row, options.bias);
  result.kappa = form.kappa;
  result.rest = form.rest;
  result.chi_square = fit.chi_square;
  result.degrees_of_freedom = fit.degrees_of_freedom;
  result.mueller = std::move(fit);
  return result;
}

/// What keeps a group from being fitted; empty if nothing.
std::string refusal(const FilmReadings& readings, const ReadingGroup& group, const ReconstructionOptions& options) {
  if (!readings.general()) {
    const std::size_t angles = distinct_angles(angle_readings(group));
    if (angles >= 3) return {};
    return fmt::format("must have readings at three angles or more, got {} for {}", angles, group.node.to_string());
  }
  const ReadingRank rank = reading_rank(mueller_readings(group, options));
  if (rank.all == 16) return {};
  return fmt::format(
      "must have readings that determine all 16 entries of the Mueller matrix, got {} that determine {} for {} "
      "(independent polarizations: illumination {} of 4, observation {} of 4)",
      group.readings.size(), rank.all, group.node.to_string(), rank.illumination, rank.observation);
}

void require_enough(const FilmReadings& readings, const ReconstructionOptions& options) {
  std::vector<core::Fault> faults;
  for (const ReadingGroup& group : readings.groups()) {
    std::string message = refusal(readings, group, options);
    if (message.empty()) continue;
    faults.push_back({readings.name(), group.readings.front().line, 1, {}, std::move(message)});
    if (faults.size() == kMaxFaults) break;
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
}

}  // namespace

void one_after_another(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

double NodeResult::excess() const {
  if (degrees_of_freedom <= 0) return 0.0;
  if (degrees_of_freedom == 1) return std::sqrt(chi_square);
  return normal_score(chi_square, degrees_of_freedom);
}

double NodeResult::contradiction() const {
  // Hermitian matrices without negative eigenvalue, of rank 1: 16 - 9 = 7 numbers.
  constexpr int kMostSettled = 9;
  return mueller ? std::max(0.0, normal_score(mueller->chi_square_increase, kMostSettled)) : 0.0;
}

std::vector<MuellerReading> mueller_readings(const ReadingGroup& group, const ReconstructionOptions& options) {
  constexpr double kDown = -1.0;
  const double out_sign = group.node.kind == ScatterKind::reflection ? 1.0 : kDown;
  std::vector<MuellerReading> readings;
  readings.reserve(group.readings.size());
  for (const FilmReading& r : group.readings) {
    readings.push_back({polarization_of(r.in_kind, r.in_angle, options.polarizer.contrast(), kDown),
                        analyzer_of(r.out_kind, r.out_angle, options.analyzer, out_sign), r.value, r.se});
  }
  return readings;
}

Reconstruction reconstruct(const FilmReadings& readings, const ReconstructionOptions& options,
                           const ForEach& for_each) {
  require_enough(readings, options);
  Reconstruction result;
  result.name = readings.name();
  result.general = readings.general();
  result.angles = options.angles;
  if (!readings.has_errors()) result.estimated_error = estimated_error(readings);
  result.has_errors = readings.has_errors() || result.estimated_error.has_value();
  result.nodes.resize(readings.groups().size());
  for_each(readings.groups().size(), [&](std::size_t i) {
    const ReadingGroup& group = readings.groups()[i];
    NodeResult& node = result.nodes[i];
    node = readings.general() ? from_both_channels(group, options) : from_angles(group, options, result);
    remove_psi(node.values, group.node, options.angles);
    node.node = group.node;
    node.line = group.readings.front().line;
  });
  return result;
}

}  // namespace evenglow::tracer

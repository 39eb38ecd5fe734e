#include "tracer/polarized_bsdf/film_readings.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/config/csv_numbers.h"
#include "core/config/text_file.h"
#include "tracer/polarized_bsdf/csv_units.h"

namespace evenglow::tracer {
namespace {

constexpr double kHuge = 1e12;
constexpr double kTiny = std::numeric_limits<double>::min();
constexpr std::size_t kMaxBytes = std::size_t{256} << 20;

enum NodeColumn : std::size_t { kKind, kPsi, kSigma, kPhi, kTheta, kLambda, kNodeColumns };

std::vector<core::CsvColumn> node_columns() {
  return {{"kind", "BRDF or BTDF", 0, 0, false, true, {"BRDF", "BTDF"}},
          {"psi_deg", "a number in [0, 180)", 0, 180, true},
          {"sigma_deg", "a number in [0, 90)", 0, 90, true},
          {"phi_deg", "a number in [0, 360)", 0, 360, true},
          {"theta_deg", "a number in [0, 180)", 0, 180, true},
          {"lambda_nm", "a number in [100, 10000]", 100, 10000}};
}

core::CsvColumn reading_column(std::string_view name, bool may_be_empty) {
  return {name, "a number in [-1e12, 1e12]", -kHuge, kHuge, false, true, {}, may_be_empty};
}

core::CsvColumn error_column(std::string_view name, bool required, bool may_be_empty) {
  return {name, "a number in (0, 1e12]", kTiny, kHuge, false, required, {}, may_be_empty};
}

constexpr std::size_t kAngles = 4;
constexpr std::size_t kFirstReading = kNodeColumns;         // b0 ... b135
constexpr std::size_t kCommonSe = kFirstReading + kAngles;  // se
constexpr std::size_t kFirstSe = kCommonSe + 1;             // se0 ... se135

const std::vector<core::CsvColumn>& angle_columns() {
  static const std::vector<core::CsvColumn> table = [] {
    std::vector<core::CsvColumn> columns = node_columns();
    for (const char* name : {"b0", "b45", "b90", "b135"}) columns.push_back(reading_column(name, true));
    columns.push_back(error_column("se", false, false));
    for (const char* name : {"se0", "se45", "se90", "se135"}) columns.push_back(error_column(name, false, true));
    return columns;
  }();
  return table;
}

enum GeneralColumn : std::size_t { kInKind = kNodeColumns, kInAngle, kOutKind, kOutAngle, kValue, kSe };

const std::vector<core::CsvColumn>& general_columns() {
  static const std::vector<core::CsvColumn> table = [] {
    std::vector<core::CsvColumn> columns = node_columns();
    const std::vector<std::string_view> kinds{"none", "linear", "right", "left"};
    for (const auto& [kind, angle] : {std::pair{"in_kind", "in_angle_deg"}, std::pair{"out_kind", "out_angle_deg"}}) {
      columns.push_back({kind, "none, linear, right or left", 0, 0, false, true, kinds});
      columns.push_back({angle, "a number in [-360, 360]", -360, 360, false, true, {}, true});
    }
    columns.push_back(reading_column("value", false));
    columns.push_back(error_column("se", true, false));
    return columns;
  }();
  return table;
}

std::optional<std::pair<std::size_t, std::string>> angle_row_fault(std::span<const double> row) {
  std::size_t empty = 0;
  for (std::size_t i = 0; i < kAngles; ++i) empty += std::isnan(row[kFirstReading + i]) ? 1 : 0;
  if (empty > 1) {
    return std::pair{kFirstReading, fmt::format("at most one of b0, b45, b90, b135 may be empty, got {}", empty)};
  }
  return std::nullopt;
}

std::optional<std::pair<std::size_t, std::string>> general_row_fault(std::span<const double> row) {
  constexpr double kLinear = static_cast<double>(PolarizerKind::linear);
  for (const std::size_t kind : {std::size_t{kInKind}, std::size_t{kOutKind}}) {
    if (row[kind] == kLinear && std::isnan(row[kind + 1])) {
      return std::pair{kind + 1, std::string("must be a number in [-360, 360] for a linear polarizer, got ''")};
    }
  }
  return std::nullopt;
}

/// The header line: the first that is neither empty nor a comment.
bool is_general(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (!line.starts_with('#') && line.find_first_not_of(" \t\r") != std::string_view::npos) {
      return line.find("in_kind") != std::string_view::npos || line.find("out_kind") != std::string_view::npos;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

}  // namespace

std::string FilmNode::to_string() const {
  return fmt::format("{} psi {} sigma {} phi {} theta {} lambda {}", kind == ScatterKind::reflection ? "BRDF" : "BTDF",
                     psi_deg, sigma_deg, phi_deg, theta_deg, lambda_nm);
}

class ReadingsBuilder {
 public:
  explicit ReadingsBuilder(const core::CsvNumbers& numbers) : numbers_(numbers) {}

  FilmReadings angles() {
    bool separate = false;
    for (std::size_t i = 0; i < kAngles; ++i) separate = separate || numbers_.has(kFirstSe + i);
    result_.has_errors_ = separate || numbers_.has(kCommonSe);
    if (separate && numbers_.has(kCommonSe)) refuse(1, "se", "must not stand beside se0, se45, se90, se135, got both");
    for (std::size_t r = 0; r < numbers_.rows(); ++r) {
      std::vector<FilmReading>& readings = groups_[node(r)];
      for (std::size_t i = 0; i < kAngles; ++i) {
        const double value = numbers_.value(r, kFirstReading + i);
        if (std::isnan(value)) continue;
        FilmReading reading{PolarizerKind::linear, PolarizerKind::none, static_cast<double>(i) * core::kPi / 4.0};
        reading.value = value;
        reading.line = numbers_.line(r);
        if (result_.has_errors_) {
          reading.se = numbers_.value(r, separate ? kFirstSe + i : kCommonSe);
          if (std::isnan(reading.se)) {
            refuse(reading.line, angle_columns()[kFirstSe + i].name,
                   "must be a number in (0, 1e12] for every reading, got none");
          }
        }
        readings.push_back(reading);
      }
    }
    return finish(false);
  }

  FilmReadings general() {
    result_.has_errors_ = true;
    for (std::size_t r = 0; r < numbers_.rows(); ++r) {
      FilmReading reading;
      reading.in_kind = static_cast<PolarizerKind>(numbers_.value(r, kInKind));
      reading.out_kind = static_cast<PolarizerKind>(numbers_.value(r, kOutKind));
      reading.in_angle = angle(r, kInAngle);
      reading.out_angle = angle(r, kOutAngle);
      reading.value = numbers_.value(r, kValue);
      reading.se = numbers_.value(r, kSe);
      reading.line = numbers_.line(r);
      groups_[node(r)].push_back(reading);
    }
    return finish(true);
  }

 private:
  FilmNode node(std::size_t row) const {
    return {static_cast<ScatterKind>(numbers_.value(row, kKind)),
            numbers_.value(row, kPsi),
            numbers_.value(row, kSigma),
            numbers_.value(row, kPhi),
            numbers_.value(row, kTheta),
            numbers_.value(row, kLambda)};
  }

  double angle(std::size_t row, std::size_t column) const {
    const double degrees = numbers_.value(row, column);
    return std::isnan(degrees) ? 0.0 : degrees * core::kRadPerDeg;
  }

  [[noreturn]] void refuse(int line, std::string_view key, std::string message) const {
    throw core::ConfigError(core::Fault{numbers_.name(), line, 1, std::string(key), std::move(message)});
  }

  FilmReadings finish(bool general) {
    result_.name_ = numbers_.name();
    result_.general_ = general;
    for (auto& [place, readings] : groups_) result_.groups_.push_back({place, std::move(readings)});
    return std::move(result_);
  }

  const core::CsvNumbers& numbers_;
  std::map<FilmNode, std::vector<FilmReading>> groups_;
  FilmReadings result_;
};

FilmReadings FilmReadings::read(const std::filesystem::path& file) {
  return parse(core::read_text_file(file, kMaxBytes), file.string());
}

FilmReadings FilmReadings::parse(std::string_view text, std::string name) {
  if (const auto fault = unit_fault(text, name, true)) throw core::ConfigError(*fault);
  if (is_general(text)) {
    return ReadingsBuilder(core::CsvNumbers::parse(text, std::move(name), general_columns(), general_row_fault))
        .general();
  }
  return ReadingsBuilder(core::CsvNumbers::parse(text, std::move(name), angle_columns(), angle_row_fault)).angles();
}

}  // namespace evenglow::tracer

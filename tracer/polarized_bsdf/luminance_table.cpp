#include "tracer/polarized_bsdf/luminance_table.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

enum Column : std::size_t { kPsi, kTheta, kIllumination, kMeasured, kPublished };

std::vector<std::string> illumination_words() {
  std::vector<std::string> words{"natural"};
  for (int degrees = 0; degrees < 180; ++degrees) words.push_back(fmt::format("lpf{}", degrees));
  return words;
}

const std::vector<core::CsvColumn>& columns() {
  static const std::vector<std::string> words = illumination_words();
  static const std::vector<core::CsvColumn> table{
      {"psi_deg", "a number in [0, 360)", 0, 360, true},
      {"theta_deg", "a number in [0, 90)", 0, 90, true},
      {"illumination", "natural, or lpf with the angle of the filter in whole degrees (lpf0 to lpf179)", 0, 0, false,
       true, std::vector<std::string_view>(words.begin(), words.end())},
      {"measured_cd_m2", "a number in [0, 1e12]", 0, 1e12},
      {"simulated_cd_m2", "a number in [0, 1e12]", 0, 1e12, false, false},
  };
  return table;
}

LuminanceTable make(const core::CsvNumbers& numbers, ScatterKind kind) {
  LuminanceTable table;
  table.name = numbers.name();
  table.kind = kind;
  std::vector<std::pair<std::tuple<double, double, double>, int>> settings;
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    const double word = numbers.value(i, kIllumination);
    LuminanceRow row;
    row.psi = numbers.value(i, kPsi) * core::kRadPerDeg;
    row.theta = numbers.value(i, kTheta) * core::kRadPerDeg;
    row.filtered = word > 0.0;
    row.filter = row.filtered ? (word - 1.0) * core::kRadPerDeg : 0.0;
    row.measured = numbers.value(i, kMeasured);
    if (numbers.has(kPublished)) row.published = numbers.value(i, kPublished);
    table.rows.push_back(row);
    settings.push_back({{row.psi, row.theta, word}, numbers.line(i)});
  }
  if (settings.empty()) throw core::ConfigError(core::Fault{table.name, 0, 0, "", "must hold readings, got none"});
  std::sort(settings.begin(), settings.end());
  for (std::size_t i = 1; i < settings.size(); ++i) {
    if (settings[i].first != settings[i - 1].first) continue;
    throw core::ConfigError(
        core::Fault{table.name, settings[i].second, 1, "",
                    fmt::format("each setting may stand once, got that of line {} again", settings[i - 1].second)});
  }
  return table;
}

}  // namespace

LuminanceTable LuminanceTable::read(const std::filesystem::path& file, ScatterKind kind) {
  return make(core::CsvNumbers::read(file, columns()), kind);
}

LuminanceTable LuminanceTable::parse(std::string_view text, std::string name, ScatterKind kind) {
  return make(core::CsvNumbers::parse(text, std::move(name), columns()), kind);
}

bool LuminanceTable::has_published() const {
  return !rows.empty() && rows.front().published >= 0.0;
}

std::string illumination_name(const LuminanceRow& row) {
  return row.filtered ? fmt::format("lpf{}", std::lround(row.filter / core::kRadPerDeg)) : "natural";
}

}  // namespace evenglow::tracer

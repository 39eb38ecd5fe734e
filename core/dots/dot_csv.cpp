#include "core/dots/dot_csv.h"

#include <array>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/csv_numbers.h"

namespace evenglow::core {
namespace {

constexpr double kFar = 1e5;  // mm
const std::array<CsvColumn, 4> kColumns = {{
    {"x_mm", "a number in [-100000, 100000]", -kFar, kFar},
    {"y_mm", "a number in [-100000, 100000]", -kFar, kFar},
    {"diameter_um", "a number in [0.01, 100000]", 0.01, 1e5},
    {"angle_deg", "a number in [-360, 360]", -360.0, 360.0, false, false},
}};

DotPattern dots_of(const CsvNumbers& table) {
  if (table.rows() == 0) throw ConfigError(Fault{table.name(), 0, 0, "", "must hold at least one dot, got none"});
  DotPattern dots(table.rows());
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const double angle = table.has(3) ? table.value(i, 3) * kRadPerDeg : 0.0;
    dots[i] = {table.value(i, 0), table.value(i, 1), static_cast<float>(0.5 * kMmPerUm * table.value(i, 2)),
               static_cast<float>(angle)};
  }
  return dots;
}

}  // namespace

DotPattern read_dot_csv(const std::filesystem::path& file) {
  return dots_of(CsvNumbers::read(file, kColumns));
}

DotPattern parse_dot_csv(std::string_view text, std::string name) {
  return dots_of(CsvNumbers::parse(text, std::move(name), kColumns));
}

}  // namespace evenglow::core

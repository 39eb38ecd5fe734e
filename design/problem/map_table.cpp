#include "design/problem/map_table.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"
#include "design/problem/regrid.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxCells = 1000000;

struct Place {
  std::string file;
  int line = 0;
};

[[noreturn]] void refuse(const Place& place, std::size_t column, const std::string& message) {
  throw core::ConfigError(core::Fault{place.file, place.line, static_cast<int>(column), "", message});
}

std::string_view trimmed(std::string_view entry) {
  while (!entry.empty() && entry.front() == ' ') entry.remove_prefix(1);
  while (!entry.empty() && (entry.back() == ' ' || entry.back() == '\r')) entry.remove_suffix(1);
  return entry;
}

double read_value(std::string_view entry, const Place& place, std::size_t column, const MapRange& range) {
  entry = trimmed(entry);
  double value = 0.0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), value);
  const bool number = error == std::errc() && end == entry.data() + entry.size();
  if (!number || !(value >= range.least && value <= range.largest)) {
    refuse(place, column, fmt::format("must be {}, got {}", range.what, core::shown(entry)));
  }
  return value;
}

void read_row(std::string_view line, const Place& place, const MapRange& range, MapTable& table) {
  int count = 0;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    table.values.push_back(read_value(line.substr(begin, comma - begin), place, begin + 1, range));
    if (table.values.size() > kMaxCells) refuse(place, 0, "must not hold more than 1000000 cells");
    ++count;
    begin = comma + 1;
  }
  if (table.ny == 0) table.nx = count;
  if (count != table.nx)
    refuse(place, 0, fmt::format("must have {} entries as the first row, got {}", table.nx, count));
  ++table.ny;
}

}  // namespace

core::CellField MapTable::over(const core::CellGrid& grid) const {
  core::CellField field(
      core::CellGrid::over(nx, ny, grid.x0, grid.y0, grid.x0 + grid.nx * grid.dx, grid.y0 + grid.ny * grid.dy), 0.0);
  field.values = values;
  return regrid(field, grid);
}

MapTable read_map_csv(const std::filesystem::path& file, const MapRange& range) {
  const std::string text = core::read_text_file(file, kMaxBytes);
  core::require_text(text, file.string());
  MapTable table;
  Place place{file.string(), 0};
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    ++place.line;
    if (!line.empty() && line.front() != '#' && line != "\r") read_row(line, place, range, table);
    begin = end + 1;
  }
  if (table.empty()) refuse({file.string(), 0}, 0, "must hold a matrix of numbers, got none");
  return table;
}

}  // namespace evenglow::design

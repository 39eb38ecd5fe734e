#include "core/config/matrix_file.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxCells = 1000000;

struct Place {
  std::string file;
  int line = 0;
};

[[noreturn]] void refuse(const Place& place, std::size_t column, const std::string& message) {
  throw ConfigError(Fault{place.file, place.line, static_cast<int>(column), "", message});
}

std::string_view trimmed(std::string_view entry) {
  while (!entry.empty() && entry.front() == ' ') entry.remove_prefix(1);
  while (!entry.empty() && (entry.back() == ' ' || entry.back() == '\r')) entry.remove_suffix(1);
  return entry;
}

double read_value(std::string_view entry, const Place& place, std::size_t column, const MatrixRange& range) {
  entry = trimmed(entry);
  double value = 0.0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), value);
  const bool number = error == std::errc() && end == entry.data() + entry.size();
  if (!number || !(value >= range.least && value <= range.largest)) {
    refuse(place, column, fmt::format("must be {}, got {}", range.what, shown(entry)));
  }
  return value;
}

void read_row(std::string_view line, const Place& place, const MatrixRange& range, NumberMatrix& matrix) {
  int count = 0;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    matrix.values.push_back(read_value(line.substr(begin, comma - begin), place, begin + 1, range));
    if (matrix.values.size() > kMaxCells) refuse(place, 0, "must not hold more than 1000000 cells");
    ++count;
    begin = comma + 1;
  }
  if (matrix.ny == 0) matrix.nx = count;
  if (count != matrix.nx)
    refuse(place, 0, fmt::format("must have {} entries as the first row, got {}", matrix.nx, count));
  ++matrix.ny;
}

}  // namespace

NumberMatrix read_matrix_csv(const std::filesystem::path& file, const MatrixRange& range) {
  const std::string text = read_text_file(file, kMaxBytes);
  require_text(text, file.string());
  NumberMatrix matrix;
  Place place{file.string(), 0};
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    ++place.line;
    if (!line.empty() && line.front() != '#' && line != "\r") read_row(line, place, range, matrix);
    begin = end + 1;
  }
  if (matrix.empty()) refuse({file.string(), 0}, 0, "must hold a matrix of numbers, got none");
  return matrix;
}

}  // namespace evenglow::core

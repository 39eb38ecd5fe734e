#include "core/config/csv_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxFaults = 10;
constexpr std::uintmax_t kMaxBytes = 256ull << 20;
constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

/// One entry of a line and its column in the file, from 1.
struct Entry {
  std::string_view text;
  int column = 1;
};

/// The entries of a line, and no more than `most` of them: a file of commas must not cost many times its size.
void split(std::string_view line, std::size_t most, std::vector<Entry>& entries) {
  entries.clear();
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    std::size_t first = begin;
    std::size_t last = comma;
    while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
    entries.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    if (comma == line.size() || entries.size() == most) return;
    begin = comma + 1;
  }
}

/// A part of the file that is safe and short enough to show in a message.
std::string shown(std::string_view text) {
  constexpr std::size_t kLength = 40;
  std::string result;
  for (const char c : text.substr(0, kLength)) result += (c >= ' ' && c <= '~') ? c : '?';
  if (text.size() > kLength) result += "...";
  return result;
}

}  // namespace

class CsvParser {
 public:
  CsvParser(std::string name, std::span<const CsvColumn> columns, const CsvNumbers::RowCheck& check)
      : columns_(columns), check_(check) {
    table_.name_ = std::move(name);
    table_.width_ = columns.size();
    table_.present_.assign(columns.size(), false);
  }

  CsvNumbers run(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty() && faults_.size() < kMaxFaults) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      take_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (faults_.empty() && header_line_ == 0) fault(0, {}, "must be a CSV table, got an empty file");
    if (faults_.empty() && table_.rows() == 0) fault(0, {}, "must hold at least one row of numbers, got none");
    if (!faults_.empty()) throw ConfigError(std::move(faults_));
    return std::move(table_);
  }

 private:
  void fault(int column, std::string_view key, std::string message) {
    faults_.push_back({table_.name_, column == 0 ? 0 : line_, column, std::string(key), std::move(message)});
  }

  void take_line(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.starts_with('#')) return;
    split(line, (header_line_ == 0 ? columns_.size() : order_.size()) + 1, entries_);
    if (header_line_ == 0) {
      take_header();
    } else {
      take_row(line);
    }
  }

  void take_header() {
    header_line_ = line_;
    for (const Entry& entry : entries_) {
      const auto known = std::ranges::find(columns_, entry.text, &CsvColumn::name);
      if (known == columns_.end()) {
        fault(entry.column, {}, fmt::format("columns must be {}, got '{}'", names(), shown(entry.text)));
        break;  // a file that is no table at all gets one line, not one for each word
      }
      const auto index = static_cast<std::size_t>(known - columns_.begin());
      if (table_.present_[index]) fault(entry.column, entry.text, "must be named once, got a second column");
      table_.present_[index] = true;
      order_.push_back(index);
    }
    if (!faults_.empty()) return stop();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].required && !table_.present_[i]) {
        fault(1, columns_[i].name, "is a required column, got a header without it");
      }
    }
    if (!faults_.empty()) stop();
  }

  /// Rows below a wrong header say nothing.
  void stop() { throw ConfigError(std::move(faults_)); }

  void take_row(std::string_view line) {
    if (entries_.size() != order_.size()) {
      fault(1, {},
            fmt::format("must have {} entries as the header (line {}), got {}", order_.size(), header_line_,
                        std::ranges::count(line, ',') + 1));
      return;
    }
    const std::size_t base = table_.values_.size();
    table_.values_.resize(base + columns_.size(), kAbsent);
    table_.lines_.push_back(line_);
    const std::size_t before = faults_.size();
    for (std::size_t i = 0; i < entries_.size(); ++i) table_.values_[base + order_[i]] = entry_value(i);
    if (faults_.size() > before || !check_) return;
    if (const auto wrong = check_(std::span(table_.values_).subspan(base))) {
      const auto place = std::ranges::find(order_, wrong->first) - order_.begin();
      fault(entries_[static_cast<std::size_t>(place)].column, columns_[wrong->first].name, wrong->second);
    }
  }

  double entry_value(std::size_t i) {
    const CsvColumn& column = columns_[order_[i]];
    const std::string_view text = entries_[i].text;
    if (text.empty() && column.may_be_empty) return kAbsent;
    if (!column.words.empty()) {
      const auto word = std::ranges::find(column.words, text);
      if (word != column.words.end()) return static_cast<double>(word - column.words.begin());
    } else {
      double value = 0.0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      const bool number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
      if (number && value >= column.min && (column.max_open ? value < column.max : value <= column.max)) return value;
    }
    fault(entries_[i].column, column.name, fmt::format("must be {}, got '{}'", column.allowed, shown(text)));
    return 0.0;
  }

  std::string names() const {
    std::string result;
    for (const CsvColumn& column : columns_) {
      if (!result.empty()) result += ',';
      result += column.name;
      if (!column.required) result += " (optional)";
    }
    return result;
  }

  std::span<const CsvColumn> columns_;
  const CsvNumbers::RowCheck& check_;
  CsvNumbers table_;
  std::vector<std::size_t> order_;  ///< known column of each column of the file
  std::vector<Entry> entries_;
  std::vector<Fault> faults_;
  int line_ = 0;
  int header_line_ = 0;
};

CsvNumbers CsvNumbers::parse(std::string_view text, std::string name, std::span<const CsvColumn> columns,
                             const RowCheck& check) {
  return CsvParser(std::move(name), columns, check).run(text);
}

CsvNumbers CsvNumbers::from_rows(std::string name, std::vector<bool> present, std::vector<double> values) {
  CsvNumbers table;
  table.name_ = std::move(name);
  table.width_ = present.size();
  table.lines_.assign(values.size() / table.width_, 0);
  table.values_ = std::move(values);
  table.present_ = std::move(present);
  return table;
}

CsvNumbers CsvNumbers::read(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                            const RowCheck& check) {
  const auto refuse = [&](std::string message) -> ConfigError {
    return ConfigError(Fault{file.string(), 0, 0, {}, std::move(message)});
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw refuse("must be an existing regular file, got none");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw refuse("must be readable, got: " + error.message());
  if (size > kMaxBytes) throw refuse(fmt::format("must be at most 256 MB, got {} bytes", size));
  std::string text(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(text.data(), static_cast<std::streamsize>(size))) throw refuse("must be readable, got a read error");
  return parse(text, file.string(), columns, check);
}

}  // namespace evenglow::core

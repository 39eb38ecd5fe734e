#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace evenglow::core {

/// One column that a reader knows: a number within [min, max] (max itself excluded if `max_open`), or one of `words`.
struct CsvColumn {
  std::string_view name;
  std::string_view allowed;  ///< what a message says is allowed: `a number in [0, 180)`
  double min = 0.0;
  double max = std::numeric_limits<double>::max();
  bool max_open = false;
  bool required = true;
  std::vector<std::string_view> words{};  ///< not empty: the column holds words, its value is the index of the word
  bool may_be_empty = false;              ///< an empty entry is allowed and reads as NaN
};

/// A CSV file of numbers: lines that begin with '#' are comments, the first other line names the columns (any order),
/// each further line is a row with one entry for each column.
///
/// Throws `ConfigError` with the first faults of the file, each `file:line:column: name: allowed, given`: not
/// readable, empty, more than 256 MB, not a text table, missing, unknown or repeated columns, a wrong number of
/// entries, an entry that is no finite number of its range or not one of its words.
class CsvNumbers {
 public:
  /// Checks a whole row (values in the order of the known columns; NaN for an absent optional column): the index of
  /// the column at fault and what is wrong.
  using RowCheck = std::function<std::optional<std::pair<std::size_t, std::string>>(std::span<const double>)>;

  static CsvNumbers read(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                         const RowCheck& check = {});
  static CsvNumbers parse(std::string_view text, std::string name, std::span<const CsvColumn> columns,
                          const RowCheck& check = {});
  /// Rows that come from no text: `values` row by row, an entry for each known column (NaN where it is not `present`).
  /// Their lines are 0.
  static CsvNumbers from_rows(std::string name, std::vector<bool> present, std::vector<double> values);

  const std::string& name() const { return name_; }
  std::size_t rows() const { return lines_.size(); }
  /// Value of row `row` in the known column `column`; NaN if that column is absent.
  double value(std::size_t row, std::size_t column) const { return values_[row * width_ + column]; }
  int line(std::size_t row) const { return lines_[row]; }  ///< from 1; 0: no text
  bool has(std::size_t column) const { return present_[column]; }

 private:
  friend class CsvParser;
  std::string name_;
  std::size_t width_ = 0;
  std::vector<double> values_;
  std::vector<int> lines_;
  std::vector<bool> present_;
};

}  // namespace evenglow::core

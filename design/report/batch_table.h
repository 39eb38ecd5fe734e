#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "design/problem/judgment.h"

/// The summary of many runs.
namespace evenglow::design {

enum class BatchStatus { kWaiting, kDone, kFailed, kWrongInput };

struct BatchRow {
  std::string name;  ///< of the run and of its folder
  std::string file;  ///< run file
  BatchStatus status = BatchStatus::kWaiting;
  std::string message;                                       ///< why it failed, or why a design stopped
  std::vector<std::pair<std::string, std::string>> changes;  ///< key path and value, as YAML text
  std::string identity;                                      ///< checksum of everything that its numbers depend on
  FinalJudgment final;                                       ///< of a run that is done
  double cpu_s = 0.0;
};

struct BatchTable {
  std::string title;
  std::string version;
  std::string command;
  std::vector<BatchRow> rows;
  std::vector<std::string> left_over = {};  ///< folders of an earlier batch in the same place, of no row of this one
};

std::string_view status_name(BatchStatus status);

/// `batch.json`: all rows; a batch that goes on is read from it.
std::string batch_json(const BatchTable& table);
/// Throws core::Error for what is no `batch.json` of this version.
BatchTable read_batch_json(const std::string& text);

/// `batch.csv`: a line for each run; the changed keys have a column each.
std::string batch_csv(const BatchTable& table);

/// `batch.html`: the same as a page whose table can be sorted, with a small picture of each luminance
/// (`thumbnail.png` in the run's folder below `directory`, if it is there) and links to the reports of the runs.
std::string batch_html(const BatchTable& table, const std::filesystem::path& directory);

/// `not of this batch: a, b, c (left from an earlier one)`, twenty names at most; empty if nothing is left over.
std::string left_over_text(const BatchTable& table);

/// Writes `batch.csv` and `batch.html`, which people read.
void write_batch_pages(const BatchTable& table, const std::filesystem::path& directory);

/// Writes a picture of the map, a pixel for each cell of small maps, at most 160 px wide.
void write_thumbnail(const core::CellField& luminance, const std::filesystem::path& file);

/// All keys that any row changes, in the order of their first appearance.
std::vector<std::string> changed_keys(const BatchTable& table);

}  // namespace evenglow::design

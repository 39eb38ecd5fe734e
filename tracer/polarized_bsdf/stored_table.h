#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/csv_numbers.h"

namespace evenglow::tracer {

/// What a film table holds at its nodes: tau_min, tau_max, delta of a diattenuator, or all of a Mueller matrix.
enum class StoredForm { diattenuator, mueller };

/// The columns that a form knows: the six of the node (`BsdfColumn`), then its values. And what is wrong with a row.
const std::vector<core::CsvColumn>& columns_of(StoredForm form);
const core::CsvNumbers::RowCheck& row_check_of(StoredForm form);

/// A film table as its file holds it, CSV or HDF5 (docs/films.md): the values of some columns at every node of a
/// rectangular grid, in the units of the file. All that `core::CsvNumbers` and `sort_to_grid` check has been checked.
struct StoredTable {
  static constexpr std::size_t kAxes = 5;  ///< psi, sigma, phi, theta (degrees), lambda (nm): kPsi ... kLambda

  std::string name;  ///< of the file
  StoredForm form = StoredForm::diattenuator;
  std::string comment;                          ///< lines of the comment above the header, without `#`; names the units
  std::vector<std::size_t> kinds;               ///< `ScatterKind`s that are there, ascending
  std::array<std::vector<double>, kAxes> axes;  ///< ascending
  /// By known column less the six of the node; index kind slowest, then psi, sigma, phi, theta, lambda. Empty: absent.
  std::vector<std::vector<double>> values;

  std::size_t nodes() const;      ///< over all kinds
  core::CsvNumbers rows() const;  ///< in the order of `values`
};

/// Does the name end in .h5 or .hdf5?
bool names_hdf5(const std::filesystem::path& file);

/// Bytes of a table file of at most 256 MB. Throws `core::ConfigError`.
std::string read_table_bytes(const std::filesystem::path& file);

/// The table in these bytes; `name` says whether they are HDF5 or CSV, the columns which form. Throws
/// `core::ConfigError`.
StoredTable parse_stored_table(std::string_view bytes, const std::string& name);
StoredTable parse_csv_table(std::string_view text, std::string name);

/// The bytes of a file: HDF5, or CSV with every number as short as it can be without loss.
std::string stored_bytes(const StoredTable& table, bool hdf5);
std::string csv_text(const StoredTable& table);

/// The comment of a table that has none.
std::string default_comment(StoredForm form);

}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/stored_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/config/text_file.h"
#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "tracer/polarized_bsdf/csv_units.h"
#include "tracer/polarized_bsdf/hdf5_table.h"
#include "tracer/polarized_bsdf/mueller_check.h"
#include "tracer/polarized_bsdf/mueller_columns.h"

namespace evenglow::tracer {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::size_t kNodeColumns = kLambda + 1;

/// The comment lines above the header, without their `#`.
std::string comment_of(std::string_view text) {
  std::string comment;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (text.starts_with('#')) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(1, end - 1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    if (!comment.empty()) comment += '\n';
    comment += line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return comment;
}

/// The six indices (kind, psi, sigma, phi, theta, lambda) of all nodes, one after another, the last fastest.
template <typename Visit>
void for_each_node(const StoredTable& table, Visit&& visit) {
  std::array<std::size_t, kNodeColumns> digit{};
  const auto size = [&](std::size_t c) { return c == 0 ? table.kinds.size() : table.axes[c - 1].size(); };
  for (std::size_t i = 0, count = table.nodes(); i < count; ++i) {
    visit(i, digit);
    std::size_t c = kNodeColumns;
    while (c > 0 && ++digit[c - 1] == size(c - 1)) digit[--c] = 0;
  }
}

double node_value(const StoredTable& table, const std::array<std::size_t, kNodeColumns>& digit, std::size_t column) {
  return column == 0 ? static_cast<double>(table.kinds[digit[0]]) : table.axes[column - 1][digit[column]];
}

/// Where a row of the sorted grid (kind, lambda, psi, sigma, theta, phi) goes.
std::size_t place_of(const BsdfGrid& grid, std::size_t i) {
  const auto take = [&i](std::size_t size) {
    const std::size_t digit = i % size;
    i /= size;
    return digit;
  };
  const std::size_t phi = take(grid.phi.size()), theta = take(grid.theta.size()), sigma = take(grid.sigma.size());
  const std::size_t psi = take(grid.psi.size()), lambda = take(grid.lambda_nm.size());
  std::size_t place = (i * grid.psi.size() + psi) * grid.sigma.size() + sigma;
  place = (place * grid.phi.size() + phi) * grid.theta.size() + theta;
  return place * grid.lambda_nm.size() + lambda;
}

}  // namespace

const std::vector<core::CsvColumn>& columns_of(StoredForm form) {
  return form == StoredForm::mueller ? mueller_columns() : bsdf_columns();
}

const core::CsvNumbers::RowCheck& row_check_of(StoredForm form) {
  static const core::CsvNumbers::RowCheck diattenuator = bsdf_row_fault;
  static const core::CsvNumbers::RowCheck mueller = mueller_row_fault;
  return form == StoredForm::mueller ? mueller : diattenuator;
}

std::string default_comment(StoredForm form) {
  if (form == StoredForm::mueller) {
    return "Mueller matrices of a film; tangential count. angles in degrees, wavelength in nm, entries in 1/sr";
  }
  return "Polarized BSDF of a film. angles in degrees, wavelength in nm, tau_min and tau_max in 1/sr (luminance / "
         "illuminance), delta in degrees from the film axis";
}

std::size_t StoredTable::nodes() const {
  std::size_t count = kinds.size();
  for (const auto& axis : axes) count *= axis.size();
  return count;
}

core::CsvNumbers StoredTable::rows() const {
  const std::size_t width = kNodeColumns + values.size();
  std::vector<bool> present(width, true);
  for (std::size_t c = 0; c < values.size(); ++c) present[kNodeColumns + c] = !values[c].empty();
  std::vector<double> numbers;
  numbers.reserve(nodes() * width);
  for_each_node(*this, [&](std::size_t i, const auto& digit) {
    for (std::size_t c = 0; c < kNodeColumns; ++c) numbers.push_back(node_value(*this, digit, c));
    for (const auto& column : values) numbers.push_back(column.empty() ? std::nan("") : column[i]);
  });
  return core::CsvNumbers::from_rows(name, std::move(present), std::move(numbers));
}

bool names_hdf5(const std::filesystem::path& file) {
  return file.extension() == ".h5" || file.extension() == ".hdf5";
}

std::string read_table_bytes(const std::filesystem::path& file) {
  return core::read_text_file(file, kMaxBytes);
}

StoredTable parse_stored_table(std::string_view bytes, const std::string& name) {
  return names_hdf5(name) ? parse_hdf5_table(bytes, name) : parse_csv_table(bytes, name);
}

StoredTable parse_csv_table(std::string_view text, std::string name) {
  if (const auto fault = unit_fault(text, name, false)) throw core::ConfigError(*fault);
  StoredTable table;
  table.name = name;
  table.form = is_mueller_file(text) ? StoredForm::mueller : StoredForm::diattenuator;
  table.comment = comment_of(text);
  const std::vector<core::CsvColumn>& columns = columns_of(table.form);
  const core::CsvNumbers rows = core::CsvNumbers::parse(text, std::move(name), columns, row_check_of(table.form));
  const BsdfGrid grid = sort_to_grid(rows);
  table.kinds = grid.kinds;
  table.axes = {grid.psi, grid.sigma, grid.phi, grid.theta, grid.lambda_nm};
  table.values.resize(columns.size() - kNodeColumns);
  for (std::size_t c = 0; c < table.values.size(); ++c) {
    if (!rows.has(kNodeColumns + c)) continue;
    table.values[c].resize(rows.rows());
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      table.values[c][place_of(grid, i)] = rows.value(grid.order[i], kNodeColumns + c);
    }
  }
  return table;
}

std::string stored_bytes(const StoredTable& table, bool hdf5) {
  return hdf5 ? hdf5_table_bytes(table) : csv_text(table);
}

std::string csv_text(const StoredTable& table) {
  std::string text = "# ";
  for (const char c : table.comment.empty() ? default_comment(table.form) : table.comment) {
    text += c;
    if (c == '\n') text += "# ";
  }
  const std::vector<core::CsvColumn>& columns = columns_of(table.form);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c >= kNodeColumns && table.values[c - kNodeColumns].empty()) continue;
    text += c == 0 ? '\n' : ',';
    text += columns[c].name;
  }
  text += '\n';
  auto out = std::back_inserter(text);
  for_each_node(table, [&](std::size_t i, const auto& digit) {
    text += table.kinds[digit[0]] == 0 ? "BRDF" : "BTDF";
    for (std::size_t c = 1; c < kNodeColumns; ++c) fmt::format_to(out, ",{}", node_value(table, digit, c));
    for (const auto& column : table.values) {
      if (!column.empty()) fmt::format_to(out, ",{}", column[i]);
    }
    text += '\n';
  });
  return text;
}

}  // namespace evenglow::tracer

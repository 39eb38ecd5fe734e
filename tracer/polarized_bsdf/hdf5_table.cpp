#include "tracer/polarized_bsdf/hdf5_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "tracer/polarized_bsdf/hdf5_reader.h"
#include "tracer/polarized_bsdf/hdf5_writer.h"

namespace evenglow::tracer {
namespace {

constexpr const char* kFormat = "evenglow-film-table";
constexpr long long kVersion = 1;
constexpr std::size_t kMostNumbers = std::size_t{32} << 20;  ///< 256 MB
constexpr std::size_t kLongestAxis = 100000;
constexpr std::size_t kMostFaults = 10;
constexpr std::size_t kChunk = std::size_t{1} << 16;  ///< numbers
constexpr std::size_t kNodeColumns = kLambda + 1;

const char* form_name(StoredForm form) {
  return form == StoredForm::mueller ? "mueller" : "diattenuator";
}

/// Name of a column's dataset: the unit goes to its attribute.
std::string dataset_of(std::string_view column) {
  for (const std::string_view ending : {"_deg", "_nm"}) {
    if (column.ends_with(ending)) column.remove_suffix(ending.size());
  }
  return std::string(column);
}

std::string unit_of(std::string_view column) {
  if (column.ends_with("_deg")) return "deg";
  if (column.ends_with("_nm")) return "nm";
  const bool pure =
      column == "kappa" || column == "rest" || column.starts_with("chi_square") || column == "degrees_of_freedom";
  return pure ? "1" : "1/sr";
}

class TableReader {
 public:
  TableReader(std::string_view bytes, const std::string& name) : file_(bytes, name) { table_.name = name; }

  StoredTable run() {
    read_head();
    check_names();
    for (std::size_t a = 0; a < StoredTable::kAxes; ++a) read_axis(a);
    finish_step();
    const auto& columns = columns_of(table_.form);
    table_.values.resize(columns.size() - kNodeColumns);
    const auto present = static_cast<std::size_t>(
        std::ranges::count_if(columns, [&](const core::CsvColumn& column) { return has(dataset_of(column.name)); }));
    std::size_t numbers = std::max<std::size_t>(present, 1) * table_.kinds.size();
    for (const auto& axis : table_.axes) {
      if (axis.size() > kMostNumbers / numbers) {
        fault({}, fmt::format("must hold at most {} numbers, got more", kMostNumbers));
        break;
      }
      numbers *= axis.size();
    }
    finish_step();
    for (std::size_t c = kNodeColumns; c < columns.size(); ++c) read_values(c);
    finish_step();
    check_rows();
    finish_step();
    return std::move(table_);
  }

 private:
  void fault(const std::string& key, std::string message) {
    if (faults_.size() < kMostFaults) faults_.push_back({table_.name, 0, 0, key, std::move(message)});
  }
  void finish_step() {
    if (!faults_.empty()) throw core::ConfigError(std::move(faults_));
  }
  bool has(const std::string& dataset) const { return std::ranges::binary_search(names_, dataset); }

  void read_head() {
    const std::string format = file_.text("", "format").value_or("none");
    if (format != kFormat) fault("format", fmt::format("must be '{}', got '{:.40}'", kFormat, format));
    finish_step();
    const long long version = file_.integer("", "version").value_or(0);
    if (version != kVersion) fault("version", fmt::format("must be {}, got {}", kVersion, version));
    const std::string form = file_.text("", "form").value_or("none");
    if (form == form_name(StoredForm::mueller)) {
      table_.form = StoredForm::mueller;
    } else if (form != form_name(StoredForm::diattenuator)) {
      fault("form", fmt::format("must be diattenuator or mueller, got '{:.40}'", form));
    }
    const std::string kind = file_.text("", "kind").value_or("none");
    if (kind != "BTDF") table_.kinds.push_back(0);
    if (kind != "BRDF") table_.kinds.push_back(1);
    if (kind != "BRDF" && kind != "BTDF" && kind != "BRDF,BTDF") {
      fault("kind", fmt::format("must be BRDF,BTDF, BRDF or BTDF, got '{:.40}'", kind));
    }
    table_.comment = file_.text("", "comment").value_or("");
    if (table_.comment.empty()) table_.comment = default_comment(table_.form);
    finish_step();
  }

  void check_names() {
    for (const core::CsvColumn& column : columns_of(table_.form)) {
      const std::string dataset = dataset_of(column.name);
      if (column.name == "kind") continue;
      if (file_.has(dataset)) {
        names_.push_back(dataset);
      } else if (column.required) {
        fault(dataset, "is a required dataset, got none");
      }
    }
    finish_step();
    if (const std::size_t links = file_.links(); links != names_.size()) {
      fault({}, fmt::format("must hold nothing but datasets of the form {}, got {} of them among {} names",
                            form_name(table_.form), names_.size(), links));
    }
    std::ranges::sort(names_);
    finish_step();
  }

  bool good_unit(const std::string& dataset, const std::string& unit) {
    const std::string got = file_.text(dataset, "unit").value_or("none");
    if (got == unit) return true;
    fault(dataset, fmt::format("must have the unit '{}', got '{:.40}'", unit, got));
    return false;
  }

  static bool allowed(const core::CsvColumn& column, double value) {
    return value >= column.min && (column.max_open ? value < column.max : value <= column.max);
  }

  void read_axis(std::size_t a) {
    const core::CsvColumn& column = columns_of(table_.form)[kPsi + a];
    const std::string dataset = dataset_of(column.name);
    const std::vector<std::size_t> shape = file_.shape(dataset);
    if (shape.size() != 1) return fault(dataset, fmt::format("must have one dimension, got {}", shape.size()));
    if (!good_unit(dataset, unit_of(column.name))) return;
    std::vector<double>& axis = table_.axes[a];
    axis = file_.numbers(dataset, kLongestAxis);
    for (std::size_t i = 0; i < axis.size(); ++i) {
      if (!allowed(column, axis[i])) return fault(dataset, fmt::format("must be {}, got {}", column.allowed, axis[i]));
      if (i > 0 && axis[i] <= axis[i - 1]) {
        return fault(dataset, fmt::format("must ascend, got {} after {}", axis[i], axis[i - 1]));
      }
    }
  }

  std::string node_text(std::size_t i) const {
    std::array<double, StoredTable::kAxes> at{};
    for (std::size_t a = StoredTable::kAxes; a-- > 0;) {
      at[a] = table_.axes[a][i % table_.axes[a].size()];
      i /= table_.axes[a].size();
    }
    return fmt::format("{} psi {} sigma {} phi {} theta {} lambda {}", table_.kinds[i] == 0 ? "BRDF" : "BTDF", at[0],
                       at[1], at[2], at[3], at[4]);
  }

  void read_values(std::size_t c) {
    const core::CsvColumn& column = columns_of(table_.form)[c];
    const std::string dataset = dataset_of(column.name);
    if (!has(dataset)) return;
    std::vector<std::size_t> expected{table_.kinds.size()};
    for (const auto& axis : table_.axes) expected.push_back(axis.size());
    const std::vector<std::size_t> shape = file_.shape(dataset);
    if (shape != expected) {
      return fault(dataset, fmt::format("must have the shape [{}] (kind, psi, sigma, phi, theta, lambda), got [{}]",
                                        fmt::join(expected, ", "), fmt::join(shape, ", ")));
    }
    if (!good_unit(dataset, unit_of(column.name))) return;
    std::vector<double>& values = table_.values[c - kNodeColumns];
    values = file_.numbers(dataset, kMostNumbers);
    const auto wrong = std::ranges::find_if(values, [&](double v) { return !allowed(column, v); });
    if (wrong == values.end()) return;
    fault(dataset, fmt::format("must be {}, got {} at {}", column.allowed, *wrong,
                               node_text(static_cast<std::size_t>(wrong - values.begin()))));
  }

  void check_rows() {
    std::vector<double> row(kNodeColumns + table_.values.size(), std::nan(""));
    for (std::size_t i = 0; i < table_.nodes() && faults_.size() < kMostFaults; ++i) {
      for (std::size_t c = 0; c < table_.values.size(); ++c) {
        if (!table_.values[c].empty()) row[kNodeColumns + c] = table_.values[c][i];
      }
      if (const auto wrong = row_check_of(table_.form)(row)) {
        fault(dataset_of(columns_of(table_.form)[wrong->first].name), wrong->second + " at " + node_text(i));
      }
    }
  }

  Hdf5Reader file_;
  std::vector<std::string> names_;  ///< sorted
  StoredTable table_;
  std::vector<core::Fault> faults_;
};

}  // namespace

StoredTable parse_hdf5_table(std::string_view bytes, const std::string& name) {
  return TableReader(bytes, name).run();
}

std::string hdf5_table_bytes(const StoredTable& table) {
  Hdf5Writer file;
  file.text("", "format", kFormat);
  file.integer("", "version", kVersion);
  file.text("", "form", form_name(table.form));
  file.text("", "kind", table.kinds.size() == 2 ? "BRDF,BTDF" : table.kinds[0] == 0 ? "BRDF" : "BTDF");
  file.text("", "comment", table.comment.empty() ? default_comment(table.form) : table.comment);
  const auto& columns = columns_of(table.form);
  std::vector<std::size_t> shape{table.kinds.size()};
  for (std::size_t a = 0; a < StoredTable::kAxes; ++a) {
    const std::string dataset = dataset_of(columns[kPsi + a].name);
    shape.push_back(table.axes[a].size());
    const std::array size{table.axes[a].size()};
    file.numbers(dataset, size, std::array{std::min(size[0], kChunk)}, table.axes[a]);
    file.text(dataset, "unit", unit_of(columns[kPsi + a].name));
  }
  std::vector<std::size_t> chunk = shape;
  for (std::size_t d = 0, size = table.nodes(); d < chunk.size() && size > kChunk; ++d) {
    const std::size_t rest = size / chunk[d];
    chunk[d] = std::max<std::size_t>(1, kChunk / rest);
    size = rest * chunk[d];
  }
  for (std::size_t c = kNodeColumns; c < columns.size(); ++c) {
    const auto& values = table.values[c - kNodeColumns];
    if (values.empty()) continue;
    const std::string dataset = dataset_of(columns[c].name);
    file.numbers(dataset, shape, chunk, values);
    file.text(dataset, "unit", unit_of(columns[c].name));
  }
  return file.bytes();
}

}  // namespace evenglow::tracer

#include "design/report/hdf5_map_writer.h"

#include <array>

#include <fmt/format.h>

#include "design/report/output_file.h"
#include "design/report/text_escape.h"
#include "tracer/polarized_bsdf/hdf5_writer.h"

namespace evenglow::design {
namespace {

using tracer::Hdf5Writer;

constexpr std::size_t kMostText = 60000;  ///< an attribute holds 64 KiB at most

void put_text(Hdf5Writer& file, const std::string& dataset, const char* attribute, const std::string& text) {
  const std::string clean = clean_utf8(std::string_view(text).substr(0, kMostText / 3));
  if (!clean.empty()) file.text(dataset, attribute, clean);
}

void put_axis(Hdf5Writer& file, const std::string& name, const char* unit, const std::string& description,
              const std::vector<double>& values) {
  const std::array<std::size_t, 1> shape{values.size()};
  file.numbers(name, shape, {}, values);
  put_text(file, name, "unit", unit);
  put_text(file, name, "description", description);
}

/// Maps with their axes: one pair of axes for each grid, in the order in which the grids come.
class MapTables {
 public:
  explicit MapTables(Hdf5Writer& file) : file_(file) {}

  void put(const NamedMap& map) {
    const core::CellGrid& grid = map.field.grid;
    const std::string axes = axes_of(grid);
    const std::array<std::size_t, 2> shape{static_cast<std::size_t>(grid.ny), static_cast<std::size_t>(grid.nx)};
    file_.numbers(map.name, shape, {}, map.field.values);
    put_text(file_, map.name, "unit", map.unit);
    put_text(file_, map.name, "description", map.description);
    put_text(file_, map.name, "axes", axes);
  }

 private:
  /// "y,x" for the first grid, "y_2,x_2" for the second.
  std::string axes_of(const core::CellGrid& grid) {
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      if (grids_[i] == grid) return fmt::format("y{0},x{0}", ending(i));
    }
    grids_.push_back(grid);
    const std::string end = ending(grids_.size() - 1);
    std::vector<double> x, y;
    for (int i = 0; i < grid.nx; ++i) x.push_back(grid.center_x(i));
    for (int i = 0; i < grid.ny; ++i) y.push_back(grid.center_y(i));
    put_axis(file_, "x" + end, "mm", "centers of the columns of cells", x);
    put_axis(file_, "y" + end, "mm", "centers of the rows of cells, from the front", y);
    return fmt::format("y{0},x{0}", end);
  }

  static std::string ending(std::size_t i) { return i == 0 ? std::string() : fmt::format("_{}", i + 1); }

  Hdf5Writer& file_;
  std::vector<core::CellGrid> grids_;
};

void put_angular(Hdf5Writer& file, const AngularLuminance& angular) {
  if (angular.polar_deg.size() < 2 || angular.azimuth_count < 1) return;
  const auto azimuths = static_cast<std::size_t>(angular.azimuth_count);
  std::vector<double> edges, values, errors;
  for (std::size_t i = 0; i <= azimuths; ++i)
    edges.push_back(360.0 * static_cast<double>(i) / static_cast<double>(azimuths));
  for (const core::Estimate& e : angular.luminance) {
    values.push_back(e.value);
    errors.push_back(e.se);
  }
  put_axis(file, "polar_edges", "deg", "edges of the bins of the polar angle, from the normal", angular.polar_deg);
  put_axis(file, "azimuth_edges", "deg", "edges of the bins of the azimuth, from x towards y", edges);
  const std::array<std::size_t, 2> shape{angular.polar_deg.size() - 1, azimuths};
  const auto put = [&](const char* name, const char* description, const std::vector<double>& numbers) {
    file.numbers(name, shape, {}, numbers);
    put_text(file, name, "unit", "cd/m2");
    put_text(file, name, "description", description);
    put_text(file, name, "axes", "polar_edges,azimuth_edges");
  };
  put("angular_luminance", "luminance by direction of view, mean over the active area", values);
  put("angular_luminance_se", "its standard error", errors);
}

void put_head(Hdf5Writer& file, const std::string& version, const std::string& title, const std::string& command) {
  file.text("", "format", "evenglow-maps");
  file.integer("", "format_version", 1);
  put_text(file, "", "program_version", version);
  put_text(file, "", "title", title);
  put_text(file, "", "command", command);
}

void put_maps(Hdf5Writer& file, const std::vector<NamedMap>& maps) {
  MapTables tables(file);
  for (const NamedMap& map : maps) tables.put(map);
}

}  // namespace

std::string hdf5_maps(const Report& report) {
  Hdf5Writer file;
  put_head(file, report.version, report.title, report.command);
  put_text(file, "", "variant", report.variant);
  put_text(file, "", "run_file_sha256", report.run_file_sha256);
  put_text(file, "", "seed", std::to_string(report.seed));
  put_maps(file, named_maps(report));
  if (report.angular) put_angular(file, *report.angular);
  return file.bytes();
}

std::string hdf5_maps(const Comparison& comparison) {
  Hdf5Writer file;
  put_head(file, comparison.variants.empty() ? "" : comparison.variants[0].version, comparison.title,
           comparison.command);
  put_maps(file, named_maps(comparison));
  return file.bytes();
}

void Hdf5MapWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_file(directory / "maps.h5", hdf5_maps(report));
}

void Hdf5MapWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  if (comparison.variants.size() > 1) write_file(directory / "maps.h5", hdf5_maps(comparison));
}

}  // namespace evenglow::design

#include "design/report/vti_writer.h"

#include <bit>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "design/report/base64.h"
#include "design/report/output_file.h"

namespace evenglow::design {
namespace {

void append_little_endian(std::string& bytes, std::uint64_t number) {
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(number >> shift & 0xFFU);
}

/// The length in bytes, then the numbers.
std::string payload(const std::vector<double>& values) {
  std::string bytes;
  bytes.reserve(8 * (values.size() + 1));
  append_little_endian(bytes, 8 * values.size());
  for (const double value : values) append_little_endian(bytes, std::bit_cast<std::uint64_t>(value));
  return base64(bytes);
}

std::string array_element(const NamedMap& map, const core::CellGrid& grid) {
  const core::CellField field = map.field.grid == grid ? map.field : core::resample_nearest(map.field, grid);
  const std::string unit = map.unit == "1" ? "" : " (" + map.unit + ")";
  return fmt::format("        <DataArray type=\"Float64\" Name=\"{}{}\" format=\"binary\">{}</DataArray>\n", map.name,
                     unit, payload(field.values));
}

void write_maps(const std::vector<NamedMap>& maps, const std::filesystem::path& directory) {
  if (maps.empty()) return;
  const core::CellGrid& grid = maps.front().field.grid;
  write_file(directory / "maps.vti", vti_text(maps, grid));
  std::vector<NamedMap> others;
  for (const NamedMap& map : maps) {
    if (map.field.grid != grid) others.push_back(map);
  }
  if (!others.empty()) write_file(directory / "density.vti", vti_text(others, others.front().field.grid));
}

}  // namespace

std::string vti_text(const std::vector<NamedMap>& maps, const core::CellGrid& grid) {
  std::string arrays;
  for (const NamedMap& map : maps) arrays += array_element(map, grid);
  const std::string extent = fmt::format("0 {} 0 {} 0 0", grid.nx, grid.ny);
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} 0\" Spacing=\"{3} {4} 1\">\n"
      "    <Piece Extent=\"{0}\">\n      <CellData Scalars=\"{5}\">\n{6}      </CellData>\n    </Piece>\n"
      "  </ImageData>\n</VTKFile>\n",
      extent, grid.x0, grid.y0, grid.dx, grid.dy,
      maps.empty() ? "" : maps.front().name + (maps.front().unit == "1" ? "" : " (" + maps.front().unit + ")"), arrays);
}

void VtiWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_maps(named_maps(report), directory);
}

void VtiWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  write_maps(named_maps(comparison), directory);
}

}  // namespace evenglow::design

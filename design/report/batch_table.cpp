#include "design/report/batch_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/cairo_drawing.h"
#include "design/report/color_map.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

std::string value_of(const BatchRow& row, const std::string& key) {
  const auto found =
      std::find_if(row.changes.begin(), row.changes.end(), [&](const auto& c) { return c.first == key; });
  return found == row.changes.end() ? "" : found->second;
}

}  // namespace

std::vector<std::string> changed_keys(const BatchTable& table) {
  std::vector<std::string> keys;
  for (const BatchRow& row : table.rows) {
    for (const auto& [key, value] : row.changes) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

std::string batch_csv(const BatchTable& table) {
  const auto keys = changed_keys(table);
  std::string text = "name,file,status";
  for (const std::string& key : keys) text += fmt::format(",{}", csv_field(key));
  text +=
      ",rms,rms_corrected,rms_corrected_se,uniformity_9,uniformity_13,luminance_mean_cd_m2,luminance_mean_se,"
      "luminance_centre_cd_m2,efficiency,efficiency_se,photons,cpu_s,message\n";
  for (const BatchRow& row : table.rows) {
    text += fmt::format("{},{},{}", csv_field(row.name), csv_field(row.file), status_name(row.status));
    for (const std::string& key : keys) text += fmt::format(",{}", csv_field(value_of(row, key)));
    const FinalJudgment& f = row.final;
    const bool done = row.status == BatchStatus::kDone;
    for (const double value :
         {f.rms, f.rms_corrected.value, f.rms_corrected.se, f.uniformity_9, f.uniformity_13, f.luminance_mean.value,
          f.luminance_mean.se, f.luminance_center, f.efficiency.value, f.efficiency.se}) {
      text += fmt::format(",{}", done ? shortest(value) : std::string());
    }
    text += done ? fmt::format(",{},{}", f.photons, shortest(row.cpu_s)) : std::string(",,");
    text += fmt::format(",{}\n", csv_field(one_line(row.message)));
  }
  return text;
}

std::string left_over_text(const BatchTable& table) {
  constexpr std::size_t kMost = 20;
  if (table.left_over.empty()) return "";
  std::string text = "not of this batch: ";
  const std::size_t shown = std::min(kMost, table.left_over.size());
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + one_line(table.left_over[i]);
  if (shown < table.left_over.size()) text += fmt::format(" and {} more", table.left_over.size() - shown);
  return text + " (left from an earlier one)";
}

void write_batch_pages(const BatchTable& table, const std::filesystem::path& directory) {
  write_file(directory / "batch.csv", batch_csv(table));
  write_file(directory / "batch.html", batch_html(table, directory));
}

void write_thumbnail(const core::CellField& luminance, const std::filesystem::path& file) {
  constexpr double kWidth = 160.0;
  const core::CellGrid& g = luminance.grid;
  const double aspect = std::clamp(g.ny * g.dy / (g.nx * g.dx), 0.1, 2.0);
  CairoDrawing drawing(static_cast<int>(kWidth), std::max(1, static_cast<int>(kWidth * aspect)));
  const ValueScale scale{0.0, std::max(summarize(luminance).max, 1e-300)};
  std::vector<Rgb> colors(g.size());
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t shown =
          static_cast<std::size_t>(g.ny - 1 - j) * static_cast<std::size_t>(g.nx) + static_cast<std::size_t>(i);
      const std::size_t cell =
          static_cast<std::size_t>(j) * static_cast<std::size_t>(g.nx) + static_cast<std::size_t>(i);
      colors[shown] = ColorMap::luminance().at(scale.share(luminance.values[cell]));
    }
  }
  drawing.cells({0, 0, kWidth, kWidth * aspect}, g.nx, g.ny, colors);
  drawing.save(file);
}

}  // namespace evenglow::design

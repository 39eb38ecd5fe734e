#include "app/dots_output.h"

#include <fmt/core.h>

#include "app/dots_pictures.h"
#include "app/dots_report.h"
#include "app/output_directory.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "design/dots/dot_files.h"
#include "design/dots/dot_index.h"
#include "design/dots/process.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFileBytes = 200;  // of a dot in all files, seen: 145 to 171

void write_sheets(const DotsOutput& output, const fs::path& directory, int threads) {
  const DotsInput& input = output.input;
  const design::DotSheet sheet{output.placement.dots, input.spec.footprint, input.plate, input.title};
  const std::array<void (*)(const design::DotSheet&, const fs::path&), 4> writers = {
      design::write_dot_csv, design::write_dot_dxf, design::write_dot_gds,
      [](const design::DotSheet& s, const fs::path& path) { design::write_dot_svg(s, path); }};
  core::run_batches(writers.size(), threads, [&](std::size_t i) { writers[i](sheet, directory / kDotFiles[i + 1]); });
}

/// The dots as the process makes them, if it changes them.
void write_made(const DotsOutput& output, const fs::path& directory, int threads, DotsReport& report) {
  const DotsInput& input = output.input;
  const design::ProcessSpread& process = input.spec.process;
  if (process.bias == 0.0 && process.size_spread == 0.0 && process.position_spread == 0.0) return;
  const core::DotPattern made = design::processed(output.placement.dots, process, input.spec.seed, threads);
  for (const core::Dot& dot : made)
    report.made_area += core::footprint_area(input.spec.footprint, 2.0 * static_cast<double>(dot.radius));
  if (made.size() > 1) {
    report.made_neighbors =
        neighbor_statistics(design::index_dots(made, input.plate, threads), input.spec.footprint, threads);
  }
  design::write_dot_csv({made, input.spec.footprint, input.plate, input.title + " (as made)"},
                        directory / "dots_made.csv");
}

}  // namespace

design::FreeArea free_area(const DotsInput& input) {
  design::FreeArea free(input.plate, input.spec.margins, input.spec.rectangles, input.spec.circles);
  const design::RectangleZone& box = free.bounds();
  if (box.x1 > box.x0 && box.y1 > box.y0) return free;
  throw core::ConfigError(core::Fault{input.run_file.empty() ? "options" : input.run_file, 0, 0, "dots.margins",
                                      fmt::format("must leave a part of the plate, {:g} x {:g} mm, got none",
                                                  input.plate.x1 - input.plate.x0, input.plate.y1 - input.plate.y0)});
}

std::optional<DotsTold> write_dots(const DotsOutput& output, const fs::path& directory, Progress& progress,
                                   int threads) {
  LapWatch watch;
  progress.line(fmt::format("{} dots; figures of quality", output.placement.dots.size()));
  const DotsQuality quality = judge_dots(output.placement.dots, output.input, output.free, output.map, threads);
  DotsReport report{output.input, output.placement, quality, output.source, output.ignored};
  report.placement_s = output.placement_s;
  report.placement_cpu_s = output.placement_cpu_s;
  report.quality_s = watch.lap();
  if (output.stop.stop_requested()) return std::nullopt;
  progress.line("files");
  make_directory(directory, kFileBytes * output.placement.dots.size());
  std::error_code ignored_failure;
  for (const char* name : kDotFiles) fs::remove(directory / name, ignored_failure);
  write_sheets(output, directory, threads);
  write_made(output, directory, threads, report);
  write_dots_pictures(report, directory);
  report.files_s = watch.lap();
  write_whole(directory / "dots.json", dots_json(report));
  return DotsTold{dots_table(report), dots_warnings(report)};
}

}  // namespace evenglow::app

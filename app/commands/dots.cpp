#include "app/commands/dots.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/dots_pictures.h"
#include "app/dots_report.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/dots/dot_csv.h"
#include "core/dots/dot_dxf.h"
#include "core/montecarlo/batches.h"
#include "design/dots/dot_files.h"
#include "design/dots/dot_index.h"
#include "design/dots/process.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 9> kFiles = {"dots.json",     "dots.csv",          "dots.dxf",
                                               "dots.gds",      "dots.svg",          "dots.png",
                                               "dots_zoom.png", "dots_spectrum.png", "dots_made.csv"};

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Output {
  fs::path directory;
  Progress& progress;
  int threads;
};

design::FreeArea free_area(const DotsInput& input) {
  const design::FreeArea free(input.plate, input.spec.margins, input.spec.rectangles, input.spec.circles);
  const design::RectangleZone& box = free.bounds();
  if (box.x1 > box.x0 && box.y1 > box.y0) return free;
  throw core::ConfigError(core::Fault{input.run_file.empty() ? "options" : input.run_file, 0, 0, "dots.margins",
                                      fmt::format("must leave a part of the plate, {:g} x {:g} mm, got none",
                                                  input.plate.x1 - input.plate.x0, input.plate.y1 - input.plate.y0)});
}

/// Figures, files and the last words of both ways.
int finish(const DotsInput& input, const design::FreeArea& free, const design::CoverageMap* map,
           const design::Placement& placement, const std::string& source, std::size_t ignored, double placement_s,
           double placement_cpu_s, const Output& out) {
  Stopwatch watch;
  out.progress.line(fmt::format("{} dots; figures of quality", placement.dots.size()));
  const DotsQuality quality = judge_dots(placement.dots, input, free, map, out.threads);
  DotsReport report{input, placement, quality, source, ignored};
  report.placement_s = placement_s;
  report.placement_cpu_s = placement_cpu_s;
  report.quality_s = watch.lap();
  out.progress.line("files");
  make_directory(out.directory);
  std::error_code ignored_failure;
  for (const char* name : kFiles) fs::remove(out.directory / name, ignored_failure);
  const design::DotSheet sheet{placement.dots, input.spec.footprint, input.plate, input.title};
  const std::array<void (*)(const design::DotSheet&, const fs::path&), 4> writers = {
      design::write_dot_csv, design::write_dot_dxf, design::write_dot_gds,
      [](const design::DotSheet& s, const fs::path& path) { design::write_dot_svg(s, path); }};
  core::run_batches(writers.size(), out.threads,
                    [&](std::size_t i) { writers[i](sheet, out.directory / kFiles[i + 1]); });
  const design::ProcessSpread& process = input.spec.process;
  if (process.bias != 0.0 || process.size_spread != 0.0 || process.position_spread != 0.0) {
    const core::DotPattern made = design::processed(placement.dots, process, input.spec.seed, out.threads);
    for (const core::Dot& dot : made)
      report.made_area += core::footprint_area(input.spec.footprint, 2.0 * static_cast<double>(dot.radius));
    if (made.size() > 1) {
      report.made_neighbors =
          neighbor_statistics(design::index_dots(made, input.plate, out.threads), input.spec.footprint, out.threads);
    }
    design::write_dot_csv({made, input.spec.footprint, input.plate, input.title + " (as made)"},
                          out.directory / "dots_made.csv");
  }
  write_dots_pictures(report, out.directory);
  report.files_s = watch.lap();
  write_whole(out.directory / "dots.json", dots_json(report));
  for (const std::string& remark : input.remarks) fmt::print(stderr, "note: {}\n", remark);
  for (const std::string& warning : dots_warnings(report)) fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("{}  files                {}\n", dots_table(report), out.directory.string());
  return kDone;
}

}  // namespace

void DotsCommand::add_key(CLI::App& command, const char* key, const char* help, const char* type) {
  command.add_option(std::string("--") + key, keys_[key], help)->type_name(type);
}

void DotsCommand::add_to(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "dots", "from the density of a design to real dots: CSV, DXF, GDSII, SVG, figures of quality, pictures");
  command.footer(
      "Example: evenglow dots out/phone_dbef --diameter_um 60 --gap_um 10 --panel_pitch_um 54\n"
      "The options named like keys replace those of the map dots of the run file.");
  command
      .add_option("SOURCE", source_,
                  "result directory of a design; or dots that exist (.csv, .dxf): their figures and files")
      ->required()
      ->type_name("PATH");
  command.add_option("--run", run_file_, "run file of the design (default: the one that result.json names)")
      ->type_name("FILE");
  command.add_option("-o,--out", out_, "directory for the files (default: SOURCE/dots, of a file out/<its name>)")
      ->type_name("DIR");
  add_key(
      command, "mode",
      "spacing: one size, blue noise (default); lattice: one pitch, the size varies; both: blue noise of varying size",
      "MODE");
  add_key(command, "diameter_um", "of every dot, mode spacing (default 60)", "UM");
  add_key(command, "diameters_um", "least and greatest diameter, modes lattice and both (default 30,100)", "UM,UM");
  add_key(command, "gap_um", "least clear distance of two dots (default 10)", "UM");
  add_key(command, "pitch_um", "of the lattice (default 120)", "UM");
  add_key(command, "lattice", "square (default) or hexagonal", "KIND");
  add_key(command, "lattice_angle_deg", "of a row of the lattice from +x (default 0)", "DEG");
  add_key(command, "size_step_um", "diameters are whole multiples of it, modes lattice and both (default 0.5)", "UM");
  add_key(command, "angle_deg", "of every dot's own axis (default 0)", "DEG");
  add_key(command, "footprint", "round or square (default: that of the shape)", "KIND");
  add_key(command, "margin_mm", "edges of the plate without dots, all four (default 0)", "MM");
  add_key(command, "panel_pitch_um", "pixel pitch of the panel, or along its x and y, for the moire figures",
          "UM[,UM]");
  add_key(command, "panel_angle_deg", "of the panel's x from +x (default 0)", "DEG");
  add_key(command, "viewing_mm", "distance of the eye (default 350)", "MM");
  add_key(command, "seed", "of the random numbers (default 1)", "N");
  command.add_option("--set", set_, "change a key of the run file: dots.process.bias_um=1 (may be repeated)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command.add_flag("--accept_shortfall", accept_shortfall_,
                   "place what the limits allow where the density asks for more");
  command.add_option("--threads", threads_, "threads (default 0: all; the result does not depend on it)")
      ->check(CLI::Range(0, 4096).description(""))
      ->type_name("N");
  command.add_flag("--quiet", quiet_, "no progress on stderr");
  command.add_flag("--overwrite", overwrite_, "replace dots that are in the directory");
  command.callback([this] { chosen_ = true; });
}

DotsOverrides DotsCommand::overrides() const {
  Options options;
  options.set = set_;
  DotsOverrides changes = option_overrides(options);
  for (const auto& [key, value] : keys_) {
    if (value.empty()) continue;
    const std::string origin = "--" + key;
    if (key == "margin_mm") {
      for (const char* side : {"left", "right", "front", "back"})
        changes.push_back({std::string("dots.margins.") + side + "_mm", value, origin});
    } else if (key == "panel_pitch_um" || key == "diameters_um") {
      const bool pair = value.find(',') != std::string::npos || value.starts_with("[");
      const std::string list = pair ? value : key == "panel_pitch_um" ? value + "," + value : value;
      changes.push_back({"dots." + key, list.starts_with("[") ? list : "[" + list + "]", origin});
    } else {
      changes.push_back({"dots." + key, value, origin});
    }
  }
  if (accept_shortfall_) changes.push_back({"dots.accept_shortfall", "true", "--accept_shortfall"});
  return changes;
}

int DotsCommand::run(const Session&) {
  std::error_code ignored;
  const bool directory = fs::is_directory(source_, ignored);
  const fs::path out = !out_.empty() ? out_ : directory ? source_ / "dots" : fs::path("out") / run_name(source_);
  if (fs::exists(out, ignored) && !fs::is_directory(out, ignored))
    throw core::ConfigError(core::Fault{core::one_line(out.string()), 0, 0, "", "must be a directory, got a file"});
  if (out_.empty() && directory) check_is_no_link(out);
  std::vector<fs::path> files;
  for (const char* name : kFiles) files.push_back(out / name);
  if (!directory) require_other_than_inputs(files, {source_});
  if (!overwrite_) require_free(files);
  return directory ? place(out) : import_pattern(out);
}

int DotsCommand::place(const fs::path& out) const {
  const DotsInput input = read_designed(source_, run_file_, overrides());
  const design::FreeArea free = free_area(input);
  Progress progress(quiet_);
  progress.line("placing the dots");
  Stopwatch watch;
  const double cpu = core::process_cpu_seconds();
  const design::CoverageMap map(*input.coverage, free);
  const design::Placement placement = place_dots(input.spec, map, threads_);
  return finish(input, free, &map, placement, source_.string(), 0, watch.lap(), core::process_cpu_seconds() - cpu,
                {out, progress, threads_});
}

int DotsCommand::import_pattern(const fs::path& out) const {
  DotsInput input = read_surroundings(run_file_, overrides());
  Progress progress(quiet_);
  progress.line("reading the dots");
  Stopwatch watch;
  const double cpu = core::process_cpu_seconds();
  std::string ending = source_.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".csv" && ending != ".dxf")
    throw core::ConfigError(core::Fault{core::one_line(source_.string()), 0, 0, "",
                                        "must be a result directory, or dots in a .csv or .dxf file"});
  design::Placement pattern;
  std::size_t ignored = 0;
  if (ending == ".csv") {
    pattern.dots = core::read_dot_csv(source_);
  } else {
    core::DxfDots drawing = core::read_dot_dxf(source_);
    pattern.dots = std::move(drawing.dots);
    ignored = drawing.ignored;
    if (ignored > 0)
      input.remarks.push_back(fmt::format("{} entities of the drawing are no circles and were left out", ignored));
  }
  for (const core::Dot& dot : pattern.dots)
    pattern.area += core::footprint_area(input.spec.footprint, 2.0 * static_cast<double>(dot.radius));
  if (input.title.empty()) input.title = source_.stem().string();
  const design::RectangleZone dots_box = design::bounds_of(pattern.dots);
  if (run_file_.empty()) input.plate = dots_box;
  const design::FreeArea free(dots_box, {}, {}, {});
  return finish(input, free, nullptr, pattern, source_.string(), ignored, watch.lap(),
                core::process_cpu_seconds() - cpu, {out, progress, threads_});
}

}  // namespace evenglow::app

#include "app/commands/dots.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/dots_output.h"
#include "app/output_directory.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/dots/dot_csv.h"
#include "core/dots/dot_dxf.h"
#include "core/montecarlo/batches.h"
#include "design/dots/dot_index.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

int interrupted(Progress& progress) {
  progress.line("interrupted: nothing was written");
  return kInterrupted;
}

/// Files, and the last words of both ways.
int finish(const DotsOutput& output, const fs::path& directory, Progress& progress, int threads) {
  const auto made = write_dots(output, directory, progress, threads);
  if (!made) return interrupted(progress);
  const DotsTold& told = *made;
  for (const std::string& remark : output.input.remarks) fmt::print(stderr, "note: {}\n", remark);
  for (const std::string& warning : told.warnings) fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("{}  files                {}\n", told.table, core::one_line(directory.string()));
  return kDone;
}

/// `[a, b]` of what may be written without brackets; of one number, `[a]`, or `[a, a]` if it stands for both axes.
std::string as_list(const std::string& value, bool for_both_axes) {
  if (value.starts_with("[")) return value;
  const bool one = value.find(',') == std::string::npos;
  return one && for_both_axes ? fmt::format("[{},{}]", value, value) : fmt::format("[{}]", value);
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
      changes.push_back({"dots." + key, as_list(value, key == "panel_pitch_um"), origin});
    } else {
      changes.push_back({"dots." + key, value, origin});
    }
  }
  if (accept_shortfall_) changes.push_back({"dots.accept_shortfall", "true", "--accept_shortfall"});
  return changes;
}

int DotsCommand::run(const Session& session) {
  std::error_code ignored;
  const bool directory = fs::is_directory(source_, ignored);
  const fs::path out = !out_.empty() ? out_ : directory ? source_ / "dots" : fs::path("out") / run_name(source_);
  if (fs::exists(out, ignored) && !fs::is_directory(out, ignored))
    throw core::ConfigError(core::Fault{core::one_line(out.string()), 0, 0, "", "must be a directory, got a file"});
  if (out_.empty() && directory) check_is_no_link(out);
  std::vector<fs::path> files;
  files.reserve(kDotFiles.size());
  for (const char* name : kDotFiles) files.push_back(out / name);
  if (!directory) require_other_than_inputs(files, {source_});
  if (!overwrite_) require_free(files);
  return directory ? place(out, session.stop) : import_pattern(out, session.stop);
}

int DotsCommand::place(const fs::path& out, const std::stop_token& stop) const {
  const DotsInput input = read_designed(source_, run_file_, overrides());
  const design::FreeArea free = free_area(input);
  Progress progress(quiet_);
  progress.line("placing the dots");
  LapWatch watch;
  const double cpu = core::process_cpu_seconds();
  const design::CoverageMap map(*input.coverage, free);
  const design::Placement placement = place_dots(input.spec, map, threads_, stop);
  if (stop.stop_requested()) return interrupted(progress);
  return finish(
      {input, free, &map, placement, source_.string(), 0, watch.lap(), core::process_cpu_seconds() - cpu, stop}, out,
      progress, threads_);
}

int DotsCommand::import_pattern(const fs::path& out, const std::stop_token& stop) const {
  DotsInput input = read_surroundings(run_file_, overrides());
  Progress progress(quiet_);
  progress.line("reading the dots");
  LapWatch watch;
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
  return finish(
      {input, free, nullptr, pattern, source_.string(), ignored, watch.lap(), core::process_cpu_seconds() - cpu, stop},
      out, progress, threads_);
}

}  // namespace evenglow::app

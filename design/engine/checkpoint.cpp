#include "design/engine/checkpoint.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/config/json_depth.h"
#include "core/config/message_text.h"
#include "design/engine/state_file.h"

namespace evenglow::design {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "evenglow-checkpoint/3";
constexpr std::uint64_t kMostPhotons = 1'000'000'000'000;  // as `trace.photons` allows
constexpr int kMaxCellsAlong = 1 << 15;                    // their product stays an int

json to_json(const core::CellField& field) {
  const core::CellGrid& g = field.grid;
  return {{"cells", {g.nx, g.ny}}, {"frame", {g.x0, g.y0, g.dx, g.dy}}, {"values", field.values}};
}

core::CellField field_from(const json& node) {
  core::CellField field;
  field.grid.nx = node.at("cells").at(0).get<int>();
  field.grid.ny = node.at("cells").at(1).get<int>();
  const auto frame = node.at("frame").get<std::array<double, 4>>();
  field.grid.x0 = frame[0];
  field.grid.y0 = frame[1];
  field.grid.dx = frame[2];
  field.grid.dy = frame[3];
  field.values = node.at("values").get<std::vector<double>>();
  core::expects(field.grid.nx > 0 && field.grid.nx <= kMaxCellsAlong && field.grid.ny > 0 &&
                    field.grid.ny <= kMaxCellsAlong && field.values.size() == field.grid.size(),
                "a value for each cell");
  return field;
}

json to_json(const StepRecord& r) {
  return {{"step", r.step},
          {"photons", r.photons},
          {"rms", r.rms},
          {"rms_corrected", {r.rms_corrected.value, r.rms_corrected.se}},
          {"efficiency", {r.efficiency.value, r.efficiency.se}},
          {"mean_density", r.mean_density},
          {"luminance_mean", r.luminance_mean},
          {"cpu_s", r.cpu_s},
          {"wall_s", r.wall_s},
          {"noise", r.noise},
          {"held", {r.held_low, r.held_high}},
          {"updater", r.updater},
          {"level_photons", r.level_photons}};
}

StepRecord step_from(const json& node) {
  const auto estimate = [&](const char* key) {
    return core::Estimate{node.at(key).at(0).get<double>(), node.at(key).at(1).get<double>()};
  };
  StepRecord r;
  r.step = node.at("step").get<int>();
  r.photons = node.at("photons").get<std::uint64_t>();
  r.rms = node.at("rms").get<double>();
  r.rms_corrected = estimate("rms_corrected");
  r.efficiency = estimate("efficiency");
  r.mean_density = node.at("mean_density").get<double>();
  r.luminance_mean = node.at("luminance_mean").get<double>();
  r.cpu_s = node.at("cpu_s").get<double>();
  r.wall_s = node.at("wall_s").get<double>();
  r.noise = node.at("noise").get<double>();
  r.held_low = node.at("held").at(0).get<int>();
  r.held_high = node.at("held").at(1).get<int>();
  r.updater = node.at("updater").get<std::string>();
  r.level_photons = node.at("level_photons").get<std::uint64_t>();
  return r;
}

json to_json(const std::string& identity, const DesignProgress& progress) {
  json steps = json::array();
  for (const StepRecord& record : progress.steps) steps.push_back(to_json(record));
  return {{"format", kFormat},
          {"identity", identity},
          {"steps", std::move(steps)},
          {"density", to_json(progress.density.cells)},
          {"photons", progress.photons},
          {"start_luminance", to_json(progress.start_luminance)},
          {"best_density", to_json(progress.best_density.cells)},
          {"best_rms", progress.best_rms},
          {"stop_reason", progress.stop_reason},
          {"level_note", progress.level_note},
          {"level_slope", progress.level_slope},
          {"limit_notes", progress.limit_notes},
          {"notes", progress.notes},
          {"memory", progress.memory}};
}

void require(bool good, const char* fault) {
  if (!good) throw core::Error(fault);
}

bool all_within(const std::vector<double>& values, double least, double largest) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value >= least && value <= largest; });
}

/// Texts are shown to the user: one line each, without control characters.
void require_lines(const DesignProgress& progress) {
  const auto good = [](const std::string& text) { return core::one_line(text) == text; };
  const auto all_good = [&](const std::vector<std::string>& texts) {
    return std::all_of(texts.begin(), texts.end(), good);
  };
  require(good(progress.stop_reason) && good(progress.level_note) && all_good(progress.limit_notes) &&
              all_good(progress.notes) &&
              std::all_of(progress.steps.begin(), progress.steps.end(),
                          [&](const StepRecord& step) { return good(step.updater); }),
          "a text of it holds control characters");
}

/// What no design writes. (JSON knows neither infinity nor what is no number.)
void check(const DesignProgress& progress) {
  require(!progress.steps.empty(), "it holds no step");
  for (std::size_t i = 0; i < progress.steps.size(); ++i) {
    require(progress.steps[i].step == static_cast<int>(i), "its steps do not count from 0");
    require(progress.steps[i].photons <= kMostPhotons, "a step of it has too many photons");
  }
  require(progress.photons <= kMostPhotons, "it asks for too many photons");
  require(
      all_within(progress.density.cells.values, 0.0, 1.0) && all_within(progress.best_density.cells.values, 0.0, 1.0),
      "its density leaves [0, 1]");
  require(all_within(progress.start_luminance.values, 0.0, std::numeric_limits<double>::max()),
          "its luminance is negative");
  require_lines(progress);
}

DesignProgress progress_from(const json& node) {
  DesignProgress progress;
  for (const json& step : node.at("steps")) progress.steps.push_back(step_from(step));
  progress.density.cells = field_from(node.at("density"));
  progress.photons = node.at("photons").get<std::uint64_t>();
  progress.start_luminance = field_from(node.at("start_luminance"));
  progress.best_density.cells = field_from(node.at("best_density"));
  progress.best_rms = node.at("best_rms").get<double>();
  progress.stop_reason = node.at("stop_reason").get<std::string>();
  progress.level_note = node.at("level_note").get<std::string>();
  progress.level_slope = node.at("level_slope").get<double>();
  progress.limit_notes = node.at("limit_notes").get<std::vector<std::string>>();
  progress.notes = node.at("notes").get<std::vector<std::string>>();
  progress.memory = node.at("memory").get<UpdaterMemory>();
  check(progress);
  return progress;
}

void check_fits(const DesignProgress& progress, const StateBounds& bounds) {
  require(progress.density.cells.grid == bounds.density && progress.best_density.cells.grid == bounds.density,
          "its density has other cells than the run file");
  require(progress.start_luminance.grid == bounds.luminance, "its luminance has other cells than the run file");
  require(progress.photons <= bounds.largest_photons, "it asks for more photons than the run file");
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const std::string& identity, const DesignProgress& progress) {
  save_state(file, to_json(identity, progress).dump());
}

DesignProgress parse_checkpoint(const std::string& object, std::string& identity) {
  try {
    core::require_shallow_json(object);
    const json node = json::parse(object);
    if (node.at("format").get<std::string>() != kFormat) throw core::Error("it is of another version");
    identity = node.at("identity").get<std::string>();
    return progress_from(node);
  } catch (const json::exception& error) {
    throw core::Error(error.what());
  }
}

std::optional<DesignProgress> load_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                              std::string* note, const StateBounds* bounds) {
  std::optional<DesignProgress> progress;
  std::string found, told;
  const auto read = [&](const std::string& object) {
    progress = parse_checkpoint(object, found);
    if (bounds != nullptr && found == identity) check_fits(*progress, *bounds);
  };
  if (!load_state(file, read, told)) return std::nullopt;
  if (found != identity) {
    throw core::Error(
        file.string() +
        ": the checkpoint is of another run (another command or program, or the run file or an option has "
        "changed)");
  }
  if (note != nullptr) *note = told;
  return progress;
}

}  // namespace evenglow::design

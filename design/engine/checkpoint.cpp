#include "design/engine/checkpoint.h"

#include <fstream>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "evenglow-checkpoint/2";

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
  core::expects(field.grid.nx > 0 && field.grid.ny > 0 && field.values.size() == field.grid.size(),
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
  core::expects(!progress.steps.empty(), "a checkpoint holds at least one step");
  return progress;
}

/// Closes the file whatever happens.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

void write_flushed(const std::filesystem::path& file, const std::string& text) {
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (out.get() < 0) throw core::Error("cannot write " + file.string());
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(out.get(), text.data() + done, text.size() - done);
    if (n <= 0) throw core::Error("cannot write " + file.string() + " (disk full?)");
    done += static_cast<std::size_t>(n);
  }
  if (::fsync(out.get()) != 0) throw core::Error("cannot write " + file.string() + " (disk full?)");
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const std::string& identity, const DesignProgress& progress) {
  const std::filesystem::path beside = file.string() + ".new";
  write_flushed(beside, to_json(identity, progress).dump());
  std::error_code failure;
  std::filesystem::rename(beside, file, failure);
  if (failure) throw core::Error("cannot write " + file.string() + ": " + failure.message());
}

std::optional<DesignProgress> load_checkpoint(const std::filesystem::path& file, const std::string& identity) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  std::optional<DesignProgress> progress;
  std::string found;
  try {
    const json node = json::parse(in);
    if (node.at("format").get<std::string>() != kFormat) throw core::Error("it is of another version");
    found = node.at("identity").get<std::string>();
    progress = progress_from(node);
  } catch (const std::exception& error) {
    throw core::Error(file.string() + ": the checkpoint cannot be used (" + error.what() + ")");
  }
  if (found != identity) {
    throw core::Error(file.string() + ": the checkpoint is of another run (the run file or an option has changed)");
  }
  return progress;
}

}  // namespace evenglow::design

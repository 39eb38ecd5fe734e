#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/run_file.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/checkpoint.h"
#include "design/engine/state_file.h"
#include "tracer/scene/refined_density.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/photon_path.h"

namespace evenglow::app {
namespace {

void print_vertex(std::size_t number, const tracer::PathVertex& vertex) {
  const core::StokesVector& light = vertex.light;
  const core::Vec3& k = light.frame.k;
  const std::string place = vertex.side.empty() ? vertex.at : vertex.at + " (" + vertex.side + ")";
  fmt::print("{:6} {:<34} {:10.4f} {:10.4f} {:10.5f}  {:8.5f} {:8.5f} {:8.5f}  {:7.4f} {:7.4f} {:7.4f}  {}\n", number,
             place, vertex.position.x(), vertex.position.y(), vertex.position.z(), k.x(), k.y(), k.z(),
             light.Q / light.I, light.U / light.I, light.V / light.I, vertex.body < 0 ? "air" : "inside");
}

/// That of the run file, or of the step that a design was at when it ended.
tracer::DensityField density_of(const Run& run, const Options& options) {
  tracer::DensityField density = tracer::initial_density(run.backlight);
  if (options.state.empty()) return density;
  const auto refuse = [&](const std::string& message) {
    throw core::ConfigError(core::Fault{"--state", 0, 0, "", message});
  };
  std::optional<tracer::DensityField> saved;
  std::string note;
  try {
    const auto read = [&](const std::string& object) {
      std::string identity;
      saved = design::parse_checkpoint(object, identity).density;
    };
    design::load_state(options.state, read, note);
  } catch (const core::Error& error) {
    refuse(core::one_line(error.what()));
  }
  if (!note.empty()) refuse(note + ": name that file to use it");
  if (!saved) refuse("must be a checkpoint.json, found none at " + core::shown(options.state.string(), 200));
  const core::CellGrid& has = saved->cells.grid;
  const core::CellGrid& wanted = density.cells.grid;
  if (has.nx != wanted.nx || has.ny != wanted.ny) refuse("must be of this run file: its density has other cells");
  return *saved;
}

}  // namespace

int trace_command(const Session& session) {
  const Options& options = session.options;
  Run run = read_run(options.files.front(), options);
  const tracer::DensityField density = tracer::traced_density(run.backlight, density_of(run, options));
  const std::uint64_t seed = run.trace.seed;
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const core::RandomKey key{seed, options.stream, options.step};
  const tracer::PhotonPath path = tracer::record_path(scene, density, key, options.photon);
  fmt::print("photon {} of step {}, stream {}, seed {}: {} nm\n", options.photon, options.step, options.stream, seed,
             scene.bands.wavelength(path.band));
  fmt::print("{:>6} {:<34} {:>10} {:>10} {:>10}  {:>8} {:>8} {:>8}  {:>7} {:>7} {:>7}  {}\n", "event", "where",
             "x (mm)", "y (mm)", "z (mm)", "k_x", "k_y", "k_z", "Q", "U", "V", "goes on in");
  for (std::size_t i = 0; i < path.vertices.size(); ++i) print_vertex(i, path.vertices[i]);
  fmt::print("{:6} {:<34} {:10.4f} {:10.4f} {:10.5f}\n", path.events, path.fate, path.end.x(), path.end.y(),
             path.end.z());
  return kDone;
}

}  // namespace evenglow::app

#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/output_directory.h"
#include "app/run_file.h"
#include "app/section_paths.h"
#include "design/report/output_file.h"
#include "tracer/scene/refined_density.h"

namespace evenglow::app {

int paths_command(const Session& session) {
  const Options& options = session.options;
  const auto& file = options.files.front();
  Run run = read_run(file, options);
  SectionOptions section;
  section.key = {run.trace.seed, 0, 0};
  section.photons = options.path_count;
  if (options.window.size() == 2) {
    section.from = options.window[0];
    section.to = options.window[1];
    if (section.to <= section.from)
      throw core::ConfigError(core::Fault{"--window", 0, 0, "", "must be two rising positions along x (mm)"});
  }
  const tracer::DensityField density = tracer::traced_density(run.backlight, tracer::initial_density(run.backlight));
  const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
  const auto picture =
      options.out.empty() ? std::filesystem::path("out") / (file.stem().string() + "_paths.svg") : options.out;
  if (std::filesystem::exists(picture) && !options.overwrite) {
    throw core::ConfigError(core::Fault{picture.string(), 0, 0, "",
                                        "must not be there yet (--overwrite replaces it, -o chooses another file)"});
  }
  if (picture.has_parent_path()) make_directory(picture.parent_path());
  design::write_file(picture, design::section_svg_file(section_view(scene, density, section)));
  fmt::print("{}\n", picture.string());
  return kDone;
}

}  // namespace evenglow::app

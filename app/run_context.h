#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "design/engine/design_loop.h"
#include "tracer/scene/scene.h"

namespace evenglow::app {

/// What a run needs besides its description.
struct RunContext {
  const Options& options;
  Progress& progress;
  std::stop_token stop;
  std::string command;                 ///< repeats the run
  std::uint32_t stream = 0;            ///< number of the variant
  std::filesystem::path checkpoint{};  ///< of a design
};

/// A checksum of everything that the bits of a run depend on: run file, changes, data files, version and stream.
std::string run_identity(const Run& run, std::uint32_t stream);

/// Photons of the first and of the largest step of the run's design.
design::DesignLimits design_limits(const Run& run);

/// The forward model that traces the scene of the run; shows its progress.
design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context);

/// `text` after the name of the variant, if there is one.
std::string label(const Run& run, const std::string& text);

/// Throws Error if a step shows a dark display: no density will light it.
void check_light(const design::StepRecord& record, const std::string& variant);

}  // namespace evenglow::app

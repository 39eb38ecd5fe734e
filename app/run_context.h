#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>

#include "app/options.h"
#include "app/output_lock.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "design/engine/checkpoint.h"
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
  const OutputLock* lock = nullptr;    ///< of the checkpoint's directory
  std::string_view work = "design";    ///< command whose state it is

  /// Throws Error if another run may write to the directory of the checkpoint by now.
  void check_lock() const {
    if (lock != nullptr) lock->check();
  }
};

/// A checksum of everything that the bits of a run depend on: program (version and build), command, stream, run file,
/// changes and data files. The data files are read for it: take it after the run was read, and a later one that is
/// equal says that nothing has changed in between.
std::string run_identity(const Run& run, std::string_view command, std::uint32_t stream = 0);

/// Throws ConfigError, at all ranks, where one of them has read something else: `identity` is that of its input.
void agree_on_input(const Options& options, const std::string& identity, const std::stop_token& stop);

/// About what states and results of the run take on the disk.
std::size_t disk_bytes(const Run& run);

/// Cells and photons that a state of the run must have.
design::StateBounds state_bounds(const Run& run);

/// Photons of the first and of the largest step of the run's design.
design::DesignLimits design_limits(const Run& run);

/// The forward model that traces the scene of the run; shows its progress.
design::ForwardModel make_model(const tracer::Scene& scene, const Run& run, const RunContext& context);

/// `text` after the name of the variant, if there is one.
std::string label(const Run& run, const std::string& text);

/// Throws Error if a step shows a dark display: no density will light it.
void check_light(const design::StepRecord& record, const std::string& variant);

}  // namespace evenglow::app

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/run_file.h"

namespace evenglow::app {

/// One run of a batch, before it is read.
struct PlannedRun {
  std::string name;  ///< of its folder; each of its own, in the order of the plan when sorted within a file
  std::filesystem::path file;
  RunPoint point;
  std::vector<core::Fault> faults;  ///< not empty: it cannot run
  std::string identity{};           ///< of all that it was planned from (run_identity); empty: it cannot run
};

/// That of a run in a batch, of designs or of single traces.
std::string batch_identity(const Run& run, Purpose purpose);

/// All runs of the files: each variant at each point of the sweep. A file that cannot be read is one run with its
/// faults. Every run has been read once, so that all faults are known before a photon is traced.
std::vector<PlannedRun> plan_batch(const Options& options, Purpose purpose);

}  // namespace evenglow::app

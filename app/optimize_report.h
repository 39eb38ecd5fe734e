#pragma once

#include <filesystem>
#include <vector>

#include "app/run_file.h"
#include "design/engine/outer_design.h"
#include "design/report/study.h"

namespace evenglow::app {

/// Two designs of a search, judged once more with random numbers that the search has not seen.
struct OptimizeVerdict {
  std::size_t best = 0;          ///< index of the evaluation; the first is the start
  bool feasible = true;          ///< false: no evaluation keeps the bound, and `best` is the nearest to it
  design::OuterResult start;     ///< judged anew
  design::OuterResult improved;  ///< judged anew
};

/// Of those designs whose RMS keeps the bound within a standard error the index of the one of the greatest efficiency;
/// that of the least RMS, and `feasible` false, if none does. `results` must not be empty.
OptimizeVerdict choose_design(const std::vector<design::OuterResult>& results, double rms_bound);

/// Convergence of the search: efficiency and RMS of each design, the keys, the verdict.
design::Study optimize_study(const Run& run, const std::string& command,
                             const std::vector<design::OuterResult>& results, const OptimizeVerdict& verdict);

/// optimize.csv, optimize.json, optimize.html, optimize.png.
void write_optimize(const design::Study& study, const Run& run, const std::vector<design::OuterResult>& results,
                    const OptimizeVerdict& verdict, const std::filesystem::path& directory);

/// The state of a search for `--resume`, and back; empty if there is none. `note` as load_state (state_file.h).
/// Throws core::Error if it is of another run or cannot be used.
std::string optimize_state(const std::string& identity, const std::vector<design::OuterResult>& results);
std::vector<design::OuterResult> read_optimize_state(const std::filesystem::path& file, const std::string& identity,
                                                     std::string& note);

}  // namespace evenglow::app

#pragma once

#include <optional>
#include <string>

#include "app/run_context.h"
#include "app/tolerance_job.h"
#include "design/tolerance/tolerance_summary.h"

namespace evenglow::app {

/// Traces the nominal design and all samples, one after another, going on from the state at `context.checkpoint` if
/// `--resume` is given; keeps the state there. Empty: interrupted, all whole samples are in the state. Throws
/// ConfigError for a state of another run, Error for a dark display.
std::optional<design::ToleranceSamples> run_tolerance(const ToleranceJob& job, const RunContext& context);

/// What a state must fit.
struct ToleranceBounds {
  core::CellGrid cells;        ///< of the display
  std::size_t parameters = 0;  ///< of each sample
  std::size_t samples = 0;     ///< at most
};

/// The state of a tolerance run as one line of JSON, and back. `identity`: of the run that it belongs to;
/// `read_tolerance_state` throws core::Error if it is of another one, does not fit the bounds, or holds numbers that no
/// run writes: anyone can make one.
std::string tolerance_state(const std::string& identity, const design::ToleranceSamples& run);
design::ToleranceSamples read_tolerance_state(const std::string& object, const std::string& identity,
                                              const ToleranceBounds& bounds);

}  // namespace evenglow::app

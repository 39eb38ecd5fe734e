#pragma once

#include <chrono>

#include "app/run_context.h"
#include "core/montecarlo/batches.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/report/report.h"
#include "tracer/scene/scene.h"

/// From a run and what it showed to its report.
namespace evenglow::app {

/// Time since it was made.
struct Stopwatch {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpu = core::process_cpu_seconds();

  double wall_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(); }
  double cpu_s() const { return core::process_cpu_seconds() - cpu; }
};

/// What can be said of a run before it is traced.
design::Report describe_run(const Run& run, const RunContext& context);

/// Maps, account and judgment of the trace that judges, and the stack in section. The density of the report must be
/// set.
void take_observation(const tracer::Scene& scene, const design::DesignSpec& spec,
                      const design::Observation& observation, design::Report& report);

/// Of a design with a bound of the color: what the final trace says of it, as a note, and in the stop reason where it
/// is broken.
void tell_color(const design::DesignSpec& spec, design::Report& report);

void finish_timing(const Stopwatch& watch, design::Report& report);

}  // namespace evenglow::app

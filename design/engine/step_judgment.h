#pragma once

#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/judgment.h"

/// An observation as the tables show it.
namespace evenglow::design {

/// The row of the convergence table for an observation.
StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation,
                            const DesignSpec& spec);

/// The judgment from a trace with fresh random numbers. Its RMS is that of luminance over target, over the cells that
/// count.
FinalJudgment make_judgment(const Observation& observation, const DesignSpec& spec);

}  // namespace evenglow::design

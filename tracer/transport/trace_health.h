#pragma once

#include <cstdint>
#include <functional>

#include "tracer/transport/batch_sums.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tracer {

/// Traces the photon with this index once more.
using PhotonReplay = std::function<void(std::uint64_t photon, BatchSums& sums)>;

/// Looks at what a trace has summed: throws Error if more than 1e-6 of the photons (and more than 10) were lost, if one
/// of them ended as a number that is none, or if a sum is no number or negative beyond rounding (1e-9 of the largest of
/// its batch). The message names the first such photon and the command that shows its way. Nothing is kept for this
/// during the trace: photons can be had again, so the batch in question is walked through once more.
void check_health(const Scene& scene, const TraceResult& result, const TraceOptions& options,
                  const PhotonReplay& replay);

}  // namespace evenglow::tracer

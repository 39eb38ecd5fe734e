#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "core/parallel/ranks.h"
#include "tracer/transport/batch_sums.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tracer {

/// The sums of each batch of a trace; null where it has not been made.
using BatchResults = std::vector<std::unique_ptr<BatchSums>>;

/// What the ranks must have in common before they divide a trace among them.
core::Agreement agreement_on(const Scene& scene, const DensityField& density, const TraceOptions& options);

/// Gives the batches `own` to the other ranks and takes theirs, so that all of `sums` are there.
void share_sums(core::RankGroup& ranks, const std::vector<std::size_t>& own, const Scene& scene, BatchResults& sums,
                const std::stop_token& stop);

}  // namespace evenglow::tracer

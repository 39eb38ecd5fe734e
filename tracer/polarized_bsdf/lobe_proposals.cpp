#include "tracer/polarized_bsdf/lobe_proposals.h"

#include <cmath>

#include "core/base/error.h"

namespace evenglow::tracer {

void LobeProposals::add(std::span<const double> weights) {
  if (weights.size() != kBlocks) throw core::Error("proposals need a weight for each block");
  double sum = 0.0;
  for (const double w : weights) sum += w;
  Table table;
  // Every block that has a weight gets one count more than its share, so that no rounding takes it below.
  table.unit = sum / (kMost - static_cast<double>(kBlocks));
  int counted = 0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    if (i % kColumns == 0) table.rows[i / kColumns] = static_cast<std::int16_t>(counted - kBias);
    table.blocks[i] = static_cast<std::int16_t>(counted - kBias);
    if (weights[i] > 0.0) counted += static_cast<int>(weights[i] / table.unit) + 1;
  }
  for (std::size_t r = kRows; r < table.rows.size(); ++r) table.rows[r] = static_cast<std::int16_t>(counted - kBias);
  table.counts = counted;
  tables_.push_back(table);
}

}  // namespace evenglow::tracer

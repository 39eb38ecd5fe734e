#include "tracer/transport/arrival_factors.h"

#include "core/base/error.h"

namespace evenglow::tracer {

ArrivalFactors::ArrivalFactors(const DensityField& traced, const DensityField& wanted) {
  if (wanted.cells.grid != traced.cells.grid) throw core::Error("records are of other cells of the density");
  for (std::size_t i = 0; i < wanted.cells.values.size(); ++i) {
    const double before = traced.cells.values[i], now = wanted.cells.values[i];
    met.push_back(before > 0.0 ? now / before : 1.0);
    passed.push_back(before < 1.0 ? (1.0 - now) / (1.0 - before) : 1.0);
    slope_passed.push_back(now < 1.0 ? -now / (1.0 - now) : 0.0);
  }
}

}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/held_totals.h"

#include <fmt/format.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kWidestNeeded = 80.0;  ///< degrees; light beyond is rare

}  // namespace

std::string HeldTotals::remark(const std::string& name, bool totals_given) const {
  const double last = last_ / core::kRadPerDeg;
  if (last >= kWidestNeeded) return "";
  return fmt::format("{}: no data beyond sigma = {:g} degrees; the lobes of that incidence are held{}", name, last,
                     totals_given ? "" : ", and its totals");
}

}  // namespace evenglow::tracer

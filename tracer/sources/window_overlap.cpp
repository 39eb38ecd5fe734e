#include "tracer/sources/window_overlap.h"

#include <algorithm>

namespace evenglow::tracer {
namespace {

constexpr double kSlack = 1e-9;  // mm

bool meet(double min_a, double max_a, double min_b, double max_b) {
  return std::min(max_a, max_b) - std::max(min_a, min_b) > kSlack;
}

}  // namespace

std::optional<double> overlap(const Source& a, const Source& b) {
  if (a.side() != b.side()) return std::nullopt;
  const std::vector<SourceWindow> first = a.windows();
  const std::vector<SourceWindow> second = b.windows();
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.size() && j < second.size()) {
    const SourceWindow& u = first[i];
    const SourceWindow& v = second[j];
    if (meet(u.min_along, u.max_along, v.min_along, v.max_along) && meet(u.min_z, u.max_z, v.min_z, v.max_z)) {
      return 0.5 * (std::max(u.min_along, v.min_along) + std::min(u.max_along, v.max_along));
    }
    ++(u.max_along < v.max_along ? i : j);
  }
  return std::nullopt;
}

}  // namespace evenglow::tracer

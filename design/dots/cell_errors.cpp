#include "design/dots/cell_errors.h"

#include <algorithm>
#include <cmath>

namespace evenglow::design {

CellErrors cell_errors(const core::DotPattern& dots, core::Footprint footprint, const CoverageMap& map) {
  const core::CellGrid& g = map.grid();
  CellErrors errors;
  std::vector<double> area(g.size(), 0.0), count(g.size(), 0.0);
  double all_area = 0.0;
  for (const core::Dot& dot : dots) {
    const auto cell = static_cast<std::size_t>(g.nearest_index(dot.x, dot.y));
    const double a = core::footprint_area(footprint, 2.0 * static_cast<double>(dot.radius));
    area[cell] += a;
    count[cell] += 1.0;
    all_area += a;
  }
  const double mean_dot = dots.empty() ? 1.0 : all_area / static_cast<double>(dots.size());
  std::size_t judged = 0, holding = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (map.free_share(i) <= 0.0) continue;
    ++judged;
    const double wanted = map.wanted(i), dot = count[i] > 0.0 ? area[i] / count[i] : mean_dot;
    const double error = (area[i] - wanted) / dot;
    errors.worst_dots = std::max(errors.worst_dots, std::abs(error));
    errors.rms_dots += error * error;
    errors.beyond_one += std::abs(error) > 1.0 + 1e-6;
    if (wanted > 0.0) {
      ++holding;
      errors.rms_relative += std::pow(area[i] / wanted - 1.0, 2);
    }
  }
  if (judged > 0) errors.rms_dots = std::sqrt(errors.rms_dots / static_cast<double>(judged));
  if (holding > 0) errors.rms_relative = std::sqrt(errors.rms_relative / static_cast<double>(holding));
  const double wanted = map.wanted_in_all();
  errors.mean_relative = wanted > 0.0 ? all_area / wanted - 1.0 : 0.0;
  errors.held = core::CellField(g, 0.0);
  for (std::size_t i = 0; i < area.size(); ++i) errors.held.values[i] = area[i] / g.cell_area();
  return errors;
}

}  // namespace evenglow::design

#include "tracer/transport/viewer_levels.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "core/base/units.h"
#include "tracer/optics/lobe_width.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

struct Extent {
  Vec3 min, max;
};

Extent extent_of(const Quad& quad) {
  Extent e{quad.corner, quad.corner};
  for (const Vec3& p : {Vec3(quad.corner + quad.u), Vec3(quad.corner + quad.v), Vec3(quad.corner + quad.u + quad.v)}) {
    e.min = e.min.cwiseMin(p);
    e.max = e.max.cwiseMax(p);
  }
  return e;
}

bool spans(const Extent& e, const Box& box) {
  constexpr double kTolerance = 1e-9;
  return (e.min - box.min).head<2>().cwiseAbs().maxCoeff() < kTolerance &&
         (e.max - box.max).head<2>().cwiseAbs().maxCoeff() < kTolerance;
}

bool is_vertical(const Extent& e) {
  return e.max.x() - e.min.x() < 1e-12 || e.max.y() - e.min.y() < 1e-12;
}

}  // namespace

ViewerLevels::ViewerLevels(const Scene& scene) : of_quad_(scene.caster->quads().size(), -1) {
  find(scene);
  cut_below_obstacles(scene);
  leave_room_for_sources(scene);
  leave_narrow_lobes(scene);
  choose_primary(scene);
  for (std::size_t i = 0; i < levels_.size(); ++i)
    of_quad_[static_cast<std::size_t>(levels_[i].quad)] = static_cast<int>(i);
}

void ViewerLevels::find(const Scene& scene) {
  const auto& quads = scene.caster->quads();
  const auto& surfaces = scene.optics.front().surfaces;
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const Extent e = extent_of(quads[i]);
    const bool outer = spans(e, scene.box);
    if (e.max.z() > e.min.z() || (!outer && !spans(e, scene.spec.area))) continue;
    ViewerLevel level;
    level.quad = static_cast<int>(i);
    level.z = e.min.z();
    level.min_x = e.min.x();
    level.max_x = e.max.x();
    level.min_y = e.min.y();
    level.max_y = e.max.y();
    level.outer = outer;
    const Surface& surface = surfaces[i];
    if (surface.body >= 0 && surface.normal.z() < 0.0) level.body_above = surface.body;
    level.patterned = surface.pattern != nullptr;
    level.windowed = !surface.windows.empty();
    level.joined = surface.optics->scatters();
    level.recorded = level.joined || (level.patterned && surface.pattern->scatters()) || level.windowed;
    levels_.push_back(level);
  }
  // Films without a gap lie at one height; they were made from below upwards.
  std::stable_sort(levels_.begin(), levels_.end(),
                   [](const ViewerLevel& a, const ViewerLevel& b) { return a.z < b.z; });
}

void ViewerLevels::cut_below_obstacles(const Scene& scene) {
  const auto& quads = scene.caster->quads();
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const Extent e = extent_of(quads[i]);
    const auto is_this = [&](const ViewerLevel& level) { return level.quad == static_cast<int>(i); };
    if (is_vertical(e) || std::any_of(levels_.begin(), levels_.end(), is_this)) continue;
    std::erase_if(levels_, [&](const ViewerLevel& level) { return level.z <= e.max.z(); });
  }
}

/// What scatters over too little is not estimated, but left to what scatters farther up or to counting. With a film
/// above that scatters over twice the angle it does not pay to estimate below it what is narrower than that.
void ViewerLevels::leave_narrow_lobes(const Scene& scene) {
  const double least = scene.spec.luminance.least_lobe;
  if (least <= 0.0) return;
  constexpr double kWidest = 75.0 * core::kRadPerDeg;
  const double wide = std::min(2.0 * least, kWidest);
  const auto& surfaces = scene.optics.front().surfaces;
  bool wide_above = false;
  for (auto& level : std::views::reverse(levels_)) {
    const Surface& surface = surfaces[static_cast<std::size_t>(level.quad)];
    if (!level.joined || level.patterned) continue;
    level.joined = spreads_over(*surface.optics, wide_above ? wide : least);
    if (!level.joined) level.recorded = level.windowed;
    if (surface.body < 0 && level.joined) wide_above = wide_above || spreads_over(*surface.optics, wide);
  }
}

/// Windows of sources stand upright beside the plate. Where one sticks out above or below it, light there may be
/// stopped by it: the levels end before it.
void ViewerLevels::leave_room_for_sources(const Scene& scene) {
  const auto& quads = scene.caster->quads();
  for (const SourcePlacement& place : scene.source_placements) {
    if (!place.quad_per_window) continue;
    const Extent e = extent_of(quads[static_cast<std::size_t>(place.first_quad)]);
    for (ViewerLevel& level : levels_) {
      if (!level.outer || !is_vertical(e)) continue;
      const int axis = e.max.x() - e.min.x() < 1e-12 ? 0 : 1;
      const double at = e.min[axis];
      double& low = axis == 0 ? level.min_x : level.min_y;
      double& high = axis == 0 ? level.max_x : level.max_y;
      if (at <= 0.5 * (low + high)) {
        low = std::max(low, at);
      } else {
        high = std::min(high, at);
      }
    }
  }
}

/// Estimates pay deep down, where many scatters each send little to many cells: at white dots and the sheet below them.
/// Without such dots all light comes through the lowest film that scatters, without one from the bottom.
void ViewerLevels::choose_primary(const Scene& scene) {
  const auto& surfaces = scene.optics.front().surfaces;
  const auto surface_of = [&](const ViewerLevel& level) -> const Surface& {
    return surfaces[static_cast<std::size_t>(level.quad)];
  };
  const auto is_film = [&](const ViewerLevel& level) {
    return level.recorded && surface_of(level).body < 0 && level.z > scene.spec.area.min.z();
  };
  const bool dots = std::any_of(levels_.begin(), levels_.end(), [&](const ViewerLevel& level) {
    return level.patterned && surface_of(level).pattern->scatters();
  });
  const auto film = std::find_if(levels_.begin(), levels_.end(), is_film);
  if (dots || film == levels_.end()) {
    for (ViewerLevel& level : levels_) level.primary = level.recorded && !is_film(level);
  } else {
    film->primary = true;
  }
}

}  // namespace evenglow::tracer

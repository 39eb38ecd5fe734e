#include "tracer/transport/next_event.h"

#include <cmath>
#include <limits>

#include "tracer/optics/dielectric_face.h"
#include "tracer/optics/opaque_reflector.h"
#include "tracer/transport/reversed_bsdf.h"
#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {
namespace {

using core::Vec2;
using core::Vec3;

/// What an estimate of the pattern that may not be met counts of a scatter.
constexpr std::size_t kPatternPart = 4;

double brdf_of(const Bsdf* surface) {
  if (dynamic_cast<const OpaqueReflector*>(surface) == nullptr) return -1.0;
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(Vec3(0, 0, -1)));
  return surface->evaluate(light, Vec3(0, 0, 1)).I;
}

}  // namespace

NextEvent::NextEvent(const Scene& scene, const DensityField& density)
    : scene_(scene),
      density_(density),
      dots_(scene, density),
      levels_(scene),
      subpath_(scene, levels_),
      active_(scene.spec.luminance.estimator == LuminanceEstimator::kNextEvent),
      inner_min_(scene.spec.area.min.head<2>()),
      inner_max_(scene.spec.area.max.head<2>()),
      outer_min_(scene.box.min.head<2>()),
      outer_max_(scene.box.max.head<2>()),
      per_cell_(1.0 / density.cells.grid.dx, 1.0 / density.cells.grid.dy) {
  for (const ViewerLevel& level : levels_.all()) {
    if (!level.outer) continue;
    outer_min_ = {level.min_x, level.min_y};
    outer_max_ = {level.max_x, level.max_y};
  }
  find_walls();
  for (const double share : density.cells.values) {
    density_per_estimate_.push_back(share > 0.0 ? share / estimates(-std::log1p(-share)) : 0.0);
  }
  for (std::size_t band = 0; band < scene.optics.size(); ++band) {
    pattern_level_.push_back(-1);
    for (int level = 0; level <= levels_.top(); ++level) {
      optics_.push_back(level_optics(level, band));
      const Bsdf* pattern = optics_.back().pattern;
      if (pattern != nullptr && pattern->scatters()) pattern_level_.back() = level;
    }
  }
}

NextEvent::LevelOptics NextEvent::level_optics(int level, std::size_t band) const {
  const SceneOptics& scene = scene_.optics[band];
  const Surface& surface = scene.surfaces[static_cast<std::size_t>(levels_[level].quad)];
  const auto per_n2 = [&](int body) {
    const double n = body >= 0 ? scene.bodies[static_cast<std::size_t>(body)].refractive_index : 1.0;
    return 1.0 / (n * n);
  };
  return {surface.optics,
          surface.pattern,
          brdf_of(surface.optics),
          brdf_of(surface.pattern),
          per_n2(levels_[level].body_above),
          per_n2(level > 0 ? levels_[level - 1].body_above : -1)};
}

bool NextEvent::meet(Coverage& coverage, const Meeting& meeting, BatchSums& sums) const {
  if (!active_) return false;
  const int level = levels_.of_quad(meeting.quad);
  if (level < 0 || !levels_[level].holds(meeting.position)) {
    const int wall = level < 0 ? wall_of_quad_[static_cast<std::size_t>(meeting.quad)] : -1;
    if (wall >= 0 && meeting.light.frame.k.z() > 0.0) {
      const auto& surfaces = scene_.optics[meeting.band].surfaces;
      meet_wall(coverage, wall, to_world(surfaces[static_cast<std::size_t>(meeting.quad)], meeting.light.frame.k),
                meeting.band);
    } else {
      coverage = {};
    }
    return false;
  }
  coverage.straight = false;
  if (std::abs(level - coverage.level) != 1) coverage.covered = false;
  coverage.level = level;
  const LevelOptics& optics = optics_of(level, meeting.band);
  const bool comes_to_pattern = level == pattern_level_[meeting.band] && meeting.light.frame.k.z() > 0.0;
  if (comes_to_pattern && meeting.told != PatternTold::kMet) {
    if (meeting.told == PatternTold::kEach) arrive_at_pattern(meeting, sums);
    return &meeting.optics == optics.pattern;
  }
  if (!meeting.optics.scatters()) return false;
  const bool is_base = &meeting.optics == optics.base;
  if (is_base && !levels_[level].joined) return false;
  if (is_base && !levels_[level].windowed && !levels_[level].primary && coverage.covered) return false;
  const double brdf = is_base ? optics.base_brdf : &meeting.optics == optics.pattern ? optics.pattern_brdf : -1.0;
  estimate(meeting, level, brdf, 1, sums);
  return true;
}

void NextEvent::arrive_at_pattern(const Meeting& meeting, BatchSums& sums) const {
  const double density = density_.at(meeting.position.x(), meeting.position.y());
  if (number(meeting.band, sums) >= estimates(-std::log1p(-density))) return;
  const Bsdf& pattern = *optics_of(pattern_level_[meeting.band], meeting.band).pattern;
  estimate_pattern({meeting.quad, pattern, meeting.light, meeting.position, meeting.band, meeting.weight}, sums);
}

void NextEvent::estimate_pattern(const Meeting& meeting, BatchSums& sums) const {
  const int level = pattern_level_[meeting.band];
  if (dots_.given()) {
    estimate(meeting, level, optics_of(level, meeting.band).pattern_brdf, 1, sums);
    return;
  }
  const std::size_t cell = cell_at(meeting.position.head<2>());
  const Vec3 weight = density_per_estimate_[cell] * meeting.weight;
  if (sums.log != nullptr) sums.log->begin_share(cell);
  estimate({meeting.quad, meeting.optics, meeting.light, meeting.position, meeting.band, weight}, level,
           optics_of(level, meeting.band).pattern_brdf, kPatternPart, sums);
  if (sums.log != nullptr) sums.log->end_share();
}

void NextEvent::leave(Coverage& coverage, const Meeting& meeting, bool estimated, bool specular) const {
  if (!active_ || coverage.level < 0 || levels_.of_quad(meeting.quad) < 0) return;
  const LevelOptics& optics = optics_of(coverage.level, meeting.band);
  if (estimated && !specular) {
    const bool dot_in_plate =
        &meeting.optics == optics.pattern && optics.pattern_brdf >= 0.0 && meeting.light.frame.k.z() > 0.0;
    coverage = {true, coverage.level, meeting.position.head<2>(), reach(meeting.position), dot_in_plate, 0};
    return;
  }
  // The pattern's and the windows' own ways with light are not part of the subpaths.
  const bool is_base = &meeting.optics == optics.base;
  if (!is_base || levels_[coverage.level].windowed) coverage.covered = false;
}

/// Total reflection leaves the natural light of a dot natural, so that the wall shows a mirror image of the dot.
void NextEvent::meet_wall(Coverage& coverage, int side, const Vec3& k, std::size_t band) const {
  const int axis = side / 2;
  const unsigned pair = 1U << static_cast<unsigned>(axis);
  // `anchors` mirrors in the nearer wall of a pair only.
  const double place = coverage.origin[axis];
  const bool lower = place - scene_.spec.area.min[axis] < scene_.spec.area.max[axis] - place;
  const bool kept = coverage.covered && coverage.straight && (coverage.walls & pair) == 0 &&
                    side == 2 * axis + (lower ? 0 : 1) && smooth_wall_[static_cast<std::size_t>(side)] &&
                    reflects_totally(k, axis, band);
  if (!kept) coverage = {};
  coverage.walls |= pair;
}

void NextEvent::find_walls() {
  wall_of_quad_.assign(scene_.caster->quads().size(), -1);
  int body = -1;
  for (const ViewerLevel& level : levels_.all()) {
    if (level.patterned && level.body_above >= 0) body = level.body_above;  // the bottom: then the top is a level too
  }
  for (const SceneOptics& band : scene_.optics) {
    plate_index_.push_back(body >= 0 ? band.bodies[static_cast<std::size_t>(body)].refractive_index : 0.0);
  }
  if (body < 0) return;
  const auto& surfaces = scene_.optics.front().surfaces;
  for (std::size_t quad = 0; quad < surfaces.size(); ++quad) {
    const Surface& face = surfaces[quad];
    if (face.body != body || dynamic_cast<const DielectricFace*>(face.optics) == nullptr || !face.windows.empty())
      continue;
    for (int side = 0; side < 4; ++side) {
      if (face.normal.dot(outward(static_cast<Side>(side))) < 1.0 - 1e-12) continue;
      wall_of_quad_[quad] = side;
      smooth_wall_[static_cast<std::size_t>(side)] = true;
    }
  }
}

bool NextEvent::covers(const Coverage& coverage, const Vec3& position) const {
  return coverage.covered && coverage.level == levels_.top() &&
         (position.head<2>() - coverage.origin).squaredNorm() <= coverage.reach * coverage.reach;
}

}  // namespace evenglow::tracer

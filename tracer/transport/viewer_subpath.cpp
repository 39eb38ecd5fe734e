#include "tracer/transport/viewer_subpath.h"

#include <cmath>

#include "tracer/transport/reversed_bsdf.h"
#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {
namespace {

using core::Vec2;

/// A walk that goes on for so long has no weight left but for rounding.
constexpr int kMaxLevels = 100000;
/// Weights below this are played for.
constexpr double kLeastWeight = 0.1;

void extend(PlaceRange& range, const Vec2& place) {
  range.min = range.min.cwiseMin(place);
  range.max = range.max.cwiseMax(place);
}

PlaceRange seen_from(const PlaceRange& range, const Vec2& place) {
  return {range.min - place, range.max - place};
}

}  // namespace

/// Places count from where the light leaves the backlight.
struct ViewerSubpath::Walk {
  core::StokesVector importance;  ///< its direction is that of the light
  int level = 0;                  ///< met last
  Vec2 place = Vec2::Zero();
  PlaceRange inner, outer;
  std::vector<PatternCrossing> crossings;  ///< places as `place`
};

void ViewerArrivals::clear() {
  for (auto& list : lists) list.clear();
  crossings.clear();
}

/// To the level; what its body takes on the way.
bool ViewerSubpath::fly(Walk& walk, int level, std::size_t band) const {
  const double rise = levels_[level].z - levels_[walk.level].z;
  const core::Vec3& k = walk.importance.frame.k;
  const int body = levels_[std::min(level, walk.level)].body_above;
  if (body >= 0) {
    const Body& bulk = scene_.optics[band].bodies[static_cast<std::size_t>(body)];
    const double extinction = bulk.absorption + (bulk.scattering ? bulk.scattering->coefficient : 0.0);
    if (extinction > 0.0) walk.importance = walk.importance.scaled(std::exp(-extinction * std::abs(rise / k.z())));
  }
  walk.place += rise / k.z() * k.head<2>();
  walk.level = level;
  return walk.place.allFinite();
}

void ViewerSubpath::record(const Walk& walk, const View& view, ViewerArrivals& arrivals) const {
  ViewerArrival arrival;
  arrival.importance = walk.importance;
  arrival.view = view;
  arrival.display = -walk.place;
  arrival.inner = seen_from(walk.inner, walk.place);
  arrival.outer = seen_from(walk.outer, walk.place);
  arrival.first_crossing = arrivals.crossings.size();
  arrival.crossings = walk.crossings.size();
  for (const PatternCrossing& crossing : walk.crossings)
    arrivals.crossings.push_back({crossing.place - walk.place, crossing.k});
  arrivals.lists[ViewerArrivals::list(walk.level, walk.importance.frame.k.z() > 0.0)].push_back(arrival);
}

/// Through the surface of the level; false: nothing comes from there.
bool ViewerSubpath::pass(Walk& walk, std::size_t band, core::PhotonRng& rng) const {
  const ViewerLevel& level = levels_[walk.level];
  if (level.windowed) return false;
  const Surface& surface = scene_.optics[band].surfaces[static_cast<std::size_t>(level.quad)];
  const BackwardPart part = level.primary                 ? BackwardPart::kSpecular
                            : walk.level == levels_.top() ? BackwardPart::kLitFromBelow
                                                          : BackwardPart::kAll;
  const auto before = step_back(*surface.optics, to_local(surface, walk.importance), part, rng);
  if (!before) return false;
  walk.importance = to_world(surface, *before);
  if (level.patterned) walk.crossings.push_back({walk.place, walk.importance.frame.k});
  if (walk.importance.I < kLeastWeight) {
    if (rng.uniform() * kLeastWeight >= walk.importance.I) return false;
    walk.importance = walk.importance.scaled(kLeastWeight / walk.importance.I);
  }
  return walk.importance.I > 0.0 && std::isfinite(walk.importance.I);
}

void ViewerSubpath::add(const View& view, std::size_t band, core::PhotonRng& rng, ViewerArrivals& arrivals) const {
  if (levels_.top() < 0) return;
  Walk walk;
  walk.importance = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(view.k));
  walk.level = levels_.top();
  for (int i = 0; i < kMaxLevels; ++i) {
    const ViewerLevel& level = levels_[walk.level];
    if (level.recorded) record(walk, view, arrivals);
    extend(level.outer ? walk.outer : walk.inner, walk.place);
    if (!pass(walk, band, rng)) return;
    const int next = walk.level + (walk.importance.frame.k.z() > 0.0 ? -1 : 1);
    if (next < 0 || next > levels_.top() || !fly(walk, next, band)) return;
  }
}

}  // namespace evenglow::tracer

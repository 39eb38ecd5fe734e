#include <cmath>
#include <limits>

#include "tracer/transport/next_event.h"
#include "tracer/transport/reversed_bsdf.h"
#include "tracer/transport/surface_frame.h"

/// What `NextEvent` adds where an estimate is due: the light of a scatter joined to the paths of a pool.
namespace evenglow::tracer {
namespace {

using core::Vec2;
using core::Vec3;

/// Subpaths of a pool, scatters that share it, and arrivals that each scatter is joined to: found by figure of merit
/// (docs/performance.md). More scatters make the maps hardly worse, but the mean luminance.
constexpr std::size_t kSubpaths = 32;
constexpr std::size_t kScatters = 400;
constexpr std::size_t kLeastJoined = 2, kMostJoined = 8;

/// `CellGrid::index_at` for many places, without divisions.
class CellFinder {
 public:
  explicit CellFinder(const core::CellGrid& grid) : grid_(grid), per_x_(1.0 / grid.dx), per_y_(1.0 / grid.dy) {}

  int index_at(const Vec2& at) const {
    const double u = (at.x() - grid_.x0) * per_x_;
    const double v = (at.y() - grid_.y0) * per_y_;
    if (!(u >= 0.0 && v >= 0.0 && u < grid_.nx && v < grid_.ny)) return -1;
    return static_cast<int>(v) * grid_.nx + static_cast<int>(u);
  }

 private:
  const core::CellGrid& grid_;
  double per_x_, per_y_;
};

}  // namespace

/// For what the subpaths of a pool have found.
void NextEvent::find_fits(ViewerArrivals& arrivals) const {
  for (auto& list : arrivals.lists) {
    for (ViewerArrival& a : list) {
      a.fits.min = (inner_min_ - a.inner.min).cwiseMax(outer_min_ - a.outer.min);
      a.fits.max = (inner_max_ - a.inner.max).cwiseMin(outer_max_ - a.outer.max);
    }
  }
}

bool NextEvent::inside(const ViewerArrival& arrival, const Vec2& at) {
  return at.x() >= arrival.fits.min.x() && at.x() <= arrival.fits.max.x() && at.y() >= arrival.fits.min.y() &&
         at.y() <= arrival.fits.max.y();
}

/// What of the light on this way meets the smooth part of the patterned face each time.
double NextEvent::open_share(const ViewerArrivals& arrivals, const ViewerArrival& arrival, const Vec2& at,
                             std::size_t band) const {
  double share = 1.0;
  for (std::size_t i = 0; i < arrival.crossings; ++i) {
    const PatternCrossing& crossing = arrivals.crossings[arrival.first_crossing + i];
    const Vec2 place = at + crossing.place;
    if (dots_.given()) {
      if (dots_.meets(place, crossing.k, band)) return 0.0;
      continue;
    }
    share *= 1.0 - density_.cells.values[cell_at(place)];
  }
  return share;
}

void NextEvent::tell_crossings(const ViewerArrivals& arrivals, const ViewerArrival& arrival, const Vec2& at,
                               ArrivalLog& log) const {
  for (std::size_t i = 0; i < arrival.crossings; ++i) {
    const Vec2 place = at + arrivals.crossings[arrival.first_crossing + i].place;
    log.crossing(cell_at(place));
  }
}

/// importance . scattered light, 1/sr.
double NextEvent::scattered_power(const Meeting& meeting, const ViewerArrival& arrival, double brdf) const {
  if (brdf >= 0.0) return brdf * meeting.light.I * arrival.importance.I;
  const Surface& surface = scene_.optics[meeting.band].surfaces[static_cast<std::size_t>(meeting.quad)];
  const core::StokesVector scattered =
      meeting.optics.evaluate(meeting.light, to_local(surface, arrival.importance.frame.k));
  return scattered.I > 0.0 ? joined(arrival.importance, to_world(surface, scattered)) : 0.0;
}

void NextEvent::renew(ViewerPool& pool, std::size_t band) const {
  pool.refill().clear();
  for (std::size_t i = 0; i < kSubpaths; ++i) {
    const double u1 = pool.rng().uniform();
    const View view = scene_.luminance.sample_view(Vec3::Zero(), u1, pool.rng().uniform());
    subpath_.add(view, band, pool.rng(), pool.refill());
  }
  find_fits(pool.refill());
  pool.renewed(kSubpaths);
  set_joins(pool);
}

/// Where light from one place leaves all over many cells, more joins spread it better.
void NextEvent::set_joins(ViewerPool& pool) const {
  const core::CellGrid& cells = scene_.luminance.cells();
  for (std::size_t list = 0; list < pool.arrivals().lists.size(); ++list) {
    const auto& arrivals = pool.arrivals().lists[list];
    double squares = 0.0;
    for (const ViewerArrival& arrival : arrivals) squares += arrival.display.squaredNorm();
    const double spread = arrivals.empty() ? 0.0 : squares / static_cast<double>(arrivals.size());
    const double wanted = static_cast<double>(kLeastJoined) + 4.0 * spread / cells.cell_area();
    pool.set_joins(list, static_cast<std::size_t>(std::min(wanted, static_cast<double>(kMostJoined))));
  }
}

/// A pupil is seen from each place in another direction, so that subpaths cannot be shared.
void NextEvent::renew_for(const Meeting& meeting, ViewerPool& pool) const {
  pool.refill().clear();
  const Vec3 above(meeting.position.x(), meeting.position.y(), scene_.box.max.z());
  const double u1 = pool.rng().uniform();
  const View view = scene_.luminance.sample_view(above, u1, pool.rng().uniform(), reach(meeting.position));
  subpath_.add(view, meeting.band, pool.rng(), pool.refill());
  find_fits(pool.refill());
  pool.renewed(1);
}

/// Light that leaves farther aside is counted: a wide reach would mean that few directions meet the pupil.
double NextEvent::reach(const Vec3& position) const {
  if (!scene_.luminance.pupil()) return std::numeric_limits<double>::infinity();
  const Vec3 way = scene_.luminance.pupil()->center - position;
  const double depth = scene_.box.max.z() - position.z();
  return depth * (1.0 + way.head<2>().norm() / way.z());
}

void NextEvent::estimate(const Meeting& meeting, int level, double brdf, std::size_t part, BatchSums& sums) const {
  ViewerPool& pool = pool_of(meeting.band, sums);
  if (scene_.luminance.pupil()) {
    renew_for(meeting, pool);
  } else if (pool.spent(part, kScatters)) {
    renew(pool, meeting.band);
  }
  if (brdf < 0.0) {
    join(meeting, ViewerArrivals::list(level, false), brdf, part, pool, sums);
    join(meeting, ViewerArrivals::list(level, true), brdf, part, pool, sums);
    return;
  }
  const Surface& surface = scene_.optics[meeting.band].surfaces[static_cast<std::size_t>(meeting.quad)];
  const bool upward = meeting.light.frame.k.z() * surface.normal.z() < 0.0;
  join(meeting, ViewerArrivals::list(level, upward), brdf, part, pool, sums);
}

void NextEvent::join(const Meeting& meeting, std::size_t list, double brdf, std::size_t part, ViewerPool& pool,
                     BatchSums& sums) const {
  const std::size_t count = pool.arrivals().lists[list].size();
  if (count == 0) return;
  const std::size_t joins = std::min(count, std::max<std::size_t>(1, 2 * pool.joins(list) / (1 + part)));
  const LevelOptics& optics = optics_of(static_cast<int>(list / 2), meeting.band);
  const double scale = static_cast<double>(count) / static_cast<double>(pool.subpaths() * joins) *
                       (list % 2 != 0 ? optics.per_n2_above : optics.per_n2_below);
  const bool with_images = brdf >= 0.0 && &meeting.optics == optics.pattern && list % 2 != 0;
  std::array<Anchor, 4> places;
  const bool pupil = scene_.luminance.pupil().has_value();
  const CellFinder cells(scene_.luminance.cells());
  const std::size_t cell_count = scene_.luminance.cells().size();
  const std::size_t place_count = anchors(meeting.position.head<2>(), with_images, meeting.band, places);
  for (std::size_t i = 0; i < joins; ++i) {
    const ViewerArrival& arrival = pool.next(list);
    double power = -1.0;  // not known yet
    for (std::size_t a = 0; a < place_count; ++a) {
      const Anchor& anchor = places[a];
      if (!inside(arrival, anchor.place)) continue;
      const Vec3& k = arrival.importance.frame.k;
      if (anchor.x && !reflects_totally(k, 0, meeting.band)) continue;
      if (anchor.y && !reflects_totally(k, 1, meeting.band)) continue;
      if (power < 0.0) power = scale * scattered_power(meeting, arrival, brdf);
      if (pupil) {
        score(meeting, arrival, anchor.place, power, pool, sums);
        continue;
      }
      const int cell = cells.index_at(anchor.place + arrival.display);
      if (cell < 0) continue;
      const std::size_t bin = arrival.view.direction * cell_count + static_cast<std::size_t>(cell);
      if (sums.log != nullptr) tell_crossings(pool.arrivals(), arrival, anchor.place, *sums.log);
      const double open =
          arrival.crossings > 0 ? open_share(pool.arrivals(), arrival, anchor.place, meeting.band) : 1.0;
      sums.add_luminance({bin, arrival.view.weight * open * power}, meeting.weight);
    }
  }
}

/// The scatter itself first. Light of a dot comes from an image of it only if it meets the wall on its way up.
std::size_t NextEvent::anchors(const Vec2& at, bool with_images, std::size_t band, std::array<Anchor, 4>& all) const {
  all[0] = {at};
  if (!with_images || plate_index_[band] <= 1.0) return 1;
  const Box& plate = scene_.spec.area;
  // Light that gets out comes up within the critical angle.
  const double n = plate_index_[band];
  const double farthest = (plate.max.z() - plate.min.z()) / std::sqrt(n * n - 1.0);
  std::size_t count = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const bool lower = at[axis] - plate.min[axis] < plate.max[axis] - at[axis];
    const double wall = lower ? plate.min[axis] : plate.max[axis];
    const int side = 2 * axis + (lower ? 0 : 1);
    if (std::abs(at[axis] - wall) > farthest || !smooth_wall_[static_cast<std::size_t>(side)]) continue;
    for (std::size_t i = 0, so_far = count; i < so_far; ++i) {
      Anchor image = all[i];
      image.place[axis] = 2.0 * wall - at[axis];
      (axis == 0 ? image.x : image.y) = true;
      all[count++] = image;
    }
  }
  return count;
}

/// Into a pupil, which is seen from each place in another direction.
void NextEvent::score(const Meeting& meeting, const ViewerArrival& arrival, const Vec2& anchor, double factor,
                      const ViewerPool& pool, BatchSums& sums) const {
  const Vec2 seen = anchor + arrival.display;
  const double reach_here = reach(meeting.position);
  if ((seen - meeting.position.head<2>()).squaredNorm() > reach_here * reach_here) return;
  const auto counted = scene_.luminance.score_view({seen.x(), seen.y(), scene_.box.max.z()}, arrival.view);
  if (!counted) return;
  const double open = arrival.crossings > 0 ? open_share(pool.arrivals(), arrival, anchor, meeting.band) : 1.0;
  if (sums.log != nullptr) tell_crossings(pool.arrivals(), arrival, anchor, *sums.log);
  sums.add_luminance({counted->bin, counted->weight * open * factor}, meeting.weight);
}

}  // namespace evenglow::tracer

#include "tracer/transport/photon_history.h"

#include <cmath>

#include "tracer/transport/surface_frame.h"

namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

/// Rounding of k and e1 grows from event to event unless it is taken out; by so little that every eighth time will do.
constexpr int kEventsPerRenormalization = 8;

/// Flights not longer than this (mm) end where they began.
constexpr double kSamePoint = 1e-9;

/// The outward normal of the box where the quad lies in its border, else zero.
Vec3 outward_of(const Quad& quad, const Box& box) {
  for (int side = 0; side < 6; ++side) {
    const auto face = static_cast<Side>(side);
    const int axis = axis_of(face);
    const bool within = quad.u[axis] == 0.0 && quad.v[axis] == 0.0 && quad.corner[axis] == box.plane(face);
    if (within) return outward(face);
  }
  return Vec3::Zero();
}

bool parallel(const Vec3& a, const Vec3& b) {
  return std::abs(a.dot(b)) > 1.0 - 1e-9;
}

void renormalize(core::PolarizationFrame& frame) {
  frame.k *= 1.5 - 0.5 * frame.k.squaredNorm();
  frame.e1 -= frame.e1.dot(frame.k) * frame.k;
  frame.e1 *= 1.5 - 0.5 * frame.e1.squaredNorm();
}

}  // namespace

PhotonHistory::PhotonHistory(const Scene& scene, const DensityField& density)
    : scene_(scene),
      quads_(scene.optics.front().surfaces),
      density_(density),
      dots_(scene, density),
      next_event_(scene, density),
      faces_(scene.optics.front().bodies.size()) {
  for (std::size_t quad = 0; quad < quads_.size(); ++quad) {
    const int body = quads_[quad].body;
    if (body >= 0) faces_[static_cast<std::size_t>(body)].push_back(static_cast<int>(quad));
    outward_.push_back(outward_of(scene.caster->quads()[quad], scene.box));
  }
}

void PhotonHistory::run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums) const {
  core::PhotonRng rng(key, photon_index);
  Walk walk = start(rng);
  walk.told = NextEvent::PatternTold::kEach;
  for (int events = 0; events < kMaxEvents; ++events) {
    sums.events[0] += 1.0;
    if (!step(walk, rng, sums)) return;
  }
  sums.energy[scene_.energy.lost_bin(LossReason::kStuck)] += 1.0;
}

PhotonHistory::Walk PhotonHistory::start(core::PhotonRng& rng) const {
  Walk walk = emit(rng);
  walk.optical_depth = -std::log(rng.uniform());
  return walk;
}

PhotonHistory::Walk PhotonHistory::emit(core::PhotonRng& rng) const {
  const auto& sources = scene_.spec.sources;
  std::size_t chosen = 0;
  if (sources.size() > 1) {
    double at = rng.uniform() * scene_.flux;
    while (chosen + 1 < sources.size() && at >= sources[chosen]->flux()) at -= sources[chosen++]->flux();
  }
  Walk walk;
  walk.photon = sources[chosen]->emit(rng);
  const SourcePlacement& place = scene_.source_placements[chosen];
  walk.photon.quad = place.quad_per_window ? place.first_quad + walk.photon.quad : place.first_quad;
  if (scene_.bands.size() > 1 || scene_.spec.color) {
    const SpectralBands::Choice choice = scene_.bands.choose(chosen, rng.uniform());
    walk.band = choice.band;
    walk.weight = choice.weight;
  }
  return walk;
}

bool PhotonHistory::can_meet(const Photon& photon, int quad) const {
  if (quad == photon.quad) return false;
  const int body = quads_[static_cast<std::size_t>(quad)].body;
  // In an edge of the box rounding lets light meet the wall that it is just leaving from behind.
  if (photon.body < 0 && body < 0) {
    return outward_[static_cast<std::size_t>(quad)].dot(photon.light.frame.k) >= 0.0;
  }
  const double slope = quads_[static_cast<std::size_t>(quad)].normal.dot(photon.light.frame.k);
  if (photon.body >= 0) return body == photon.body && slope > 0.0;
  const int left_body = photon.quad >= 0 ? quads_[static_cast<std::size_t>(photon.quad)].body : -1;
  return body != left_body && slope < 0.0;
}

bool PhotonHistory::consistent(const Photon& photon, const RayHit& hit) const {
  if (hit.quad < 0) return photon.body < 0;
  const Surface& surface = quads_[static_cast<std::size_t>(hit.quad)];
  return can_meet(photon, hit.quad) && (photon.body >= 0 || !surface.is_trimmed() || surface.holds(hit.position));
}

RayHit PhotonHistory::next_hit(const Walk& walk) const {
  const Photon& photon = walk.photon;
  if (photon.body >= 0) {
    const auto& faces = faces_[static_cast<std::size_t>(photon.body)];
    return scene_.caster->exit_of(faces, photon.position, photon.light.frame.k, photon.quad);
  }
  RayHit hit = scene_.caster->nearest(photon.position, photon.light.frame.k, photon.quad);
  // Two quads that touch all over (a sheet's side and the wall) are no corner: light goes from one to the other. Walls
  // of the box need no such rule: whether light goes towards them or away is known.
  const bool back_into_corner = hit.quad >= 0 && hit.quad == walk.corner && hit.distance <= kSamePoint &&
                                outward_[static_cast<std::size_t>(hit.quad)].isZero(0.0) &&
                                !parallel(quads_[static_cast<std::size_t>(hit.quad)].normal,
                                          quads_[static_cast<std::size_t>(photon.quad)].normal);
  if (consistent(photon, hit) && !back_into_corner) return hit;
  // A trimmed wall that was met where it is cut off is passed.
  const bool beyond_trim = hit.quad >= 0 && quads_[static_cast<std::size_t>(hit.quad)].is_trimmed();
  const int passed = back_into_corner ? walk.corner : beyond_trim ? hit.quad : -1;
  return scene_.caster->nearest_exact(photon.position, photon.light.frame.k,
                                      [&](int quad) { return quad != passed && can_meet(photon, quad); });
}

PhotonHistory::Encounter PhotonHistory::meet(const Surface& surface, const Walk& walk, const Vec3& position,
                                             core::PhotonRng& rng) const {
  if (surface.pattern != nullptr) {
    const bool met = dots_.given() ? dots_.meets(position.head<2>(), walk.photon.light.frame.k, walk.band)
                                   : rng.uniform() < density_.at(position.x(), position.y());
    if (met) return {surface.pattern, surface.pattern_part};
  }
  if (!surface.windows.empty()) {
    const double x = surface.x.dot(position);
    const double y = surface.y.dot(position);
    for (const SurfaceWindow& w : surface.windows) {
      if (x >= w.min_x && x <= w.max_x && y >= w.min_y && y <= w.max_y) return {w.optics, w.part};
    }
  }
  return {surface.optics, surface.part};
}

std::optional<BsdfSample> PhotonHistory::sample(const Surface& surface, const Walk& walk, const Encounter& encounter,
                                                const StokesVector& light, Vec3& position, core::PhotonRng& rng) const {
  const bool among_dots = dots_.given() && encounter.optics == surface.pattern && dots_.shape(walk.band) != nullptr;
  if (!among_dots) return encounter.optics->sample(light, rng);
  auto outcome = dots_.shape(walk.band)->sample_among(dots_.grid(), position.head<2>(), walk.photon.light, rng);
  if (!outcome) return std::nullopt;
  const Box& area = scene_.spec.area;
  if (outcome->place.allFinite()) {
    position.head<2>() = outcome->place.cwiseMax(area.min.head<2>()).cwiseMin(area.max.head<2>());
  }
  return BsdfSample{to_local(surface, outcome->light), true};
}

void PhotonHistory::escape_by(Side side, const Walk& walk, BatchSums& sums) const {
  const Photon& photon = walk.photon;
  Crossing crossing;
  crossing.k = photon.light.frame.k;
  crossing.side = side;
  const int axis = axis_of(crossing.side);
  const double distance = (scene_.box.plane(crossing.side) - photon.position[axis]) / crossing.k[axis];
  crossing.position = photon.position + (std::isfinite(distance) ? distance : 0.0) * crossing.k;
  crossing.estimated = next_event_.covers(walk.coverage, crossing.position);
  escape(walk, crossing, sums);
}

void PhotonHistory::escape(const Walk& walk, const Crossing& crossing, BatchSums& sums) const {
  const double flux = walk.weight.y();
  for (std::size_t direction = 0; direction < scene_.luminance.directions(); ++direction) {
    if (const auto score = scene_.luminance.score(crossing, direction)) sums.add_luminance(*score, walk.weight);
  }
  if (const auto score = scene_.energy.score(crossing)) sums.energy[score->bin] += score->weight * flux;
  if (!scene_.angular) return;
  if (const auto score = scene_.angular->score(crossing)) sums.angular[score->bin] += score->weight * flux;
  if (const auto score = scene_.angular->spot_score(crossing)) sums.angular[score->bin] += score->weight * flux;
}

bool PhotonHistory::scatters_within(Walk& walk, const Body& body, double distance, core::PhotonRng& rng) const {
  Photon& photon = walk.photon;
  const double way = body.scattering->free_path(rng);
  if (way >= distance) return false;
  walk.optical_depth -= body.absorption * way;
  photon.position += way * photon.light.frame.k;
  photon.light = body.scattering->scatter(photon.light, rng);
  if (++walk.events % kEventsPerRenormalization == 0) renormalize(photon.light.frame);
  photon.quad = -1;
  walk.corner = -1;
  walk.coverage = {};
  return true;
}

bool PhotonHistory::step(Walk& walk, core::PhotonRng& rng, BatchSums& sums) const {
  const RayHit hit = next_hit(walk);
  if (!consistent(walk.photon, hit)) {
    sums.energy[scene_.energy.lost_bin(LossReason::kLeak)] += 1.0;
    return false;
  }
  if (hit.quad < 0) {
    escape(walk, sums);
    return false;
  }
  switch (fly(walk, hit.distance, rng, sums)) {
    case Flight::kAbsorbed:
      return false;
    case Flight::kScattered:
      return true;
    case Flight::kArrived:
      break;
  }
  return interact(walk, hit, rng, sums);
}

PhotonHistory::Flight PhotonHistory::fly(Walk& walk, double distance, core::PhotonRng& rng, BatchSums& sums) const {
  if (walk.photon.body < 0) return Flight::kArrived;
  const Body& body = scene_.optics[walk.band].bodies[static_cast<std::size_t>(walk.photon.body)];
  const bool scattered = body.scattering && scatters_within(walk, body, distance, rng);
  if (!scattered) walk.optical_depth -= body.absorption * distance;
  if (walk.optical_depth <= 0.0) {
    sums.energy[scene_.energy.absorbed_bin(body.part)] += walk.weight.y();
    return Flight::kAbsorbed;
  }
  return scattered ? Flight::kScattered : Flight::kArrived;
}

bool PhotonHistory::interact(Walk& walk, const RayHit& hit, core::PhotonRng& rng, BatchSums& sums) const {
  const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit.quad)];
  const Encounter encounter = meet(surface, walk, hit.position, rng);
  if (sums.log != nullptr && surface.pattern != nullptr) {
    const int cell = density_.cells.grid.nearest_index(hit.position.x(), hit.position.y());
    sums.log->arrival(static_cast<std::size_t>(cell), encounter.optics == surface.pattern);
  }
  return interact(walk, hit, encounter, rng, sums);
}

bool PhotonHistory::interact(Walk& walk, const RayHit& hit, const Encounter& encounter, core::PhotonRng& rng,
                             BatchSums& sums) const {
  Photon& photon = walk.photon;
  const Surface& surface = scene_.optics[walk.band].surfaces[static_cast<std::size_t>(hit.quad)];
  const bool upright = is_upright(surface);
  StokesVector turned;
  if (!upright) turned = to_local(surface, photon.light);
  const StokesVector& light = upright ? photon.light : turned;
  const NextEvent::Meeting meeting{hit.quad, *encounter.optics, light, hit.position, walk.band, walk.weight, walk.told};
  const bool estimated = next_event_.meet(walk.coverage, meeting, sums);
  const double k_before = light.frame.k.z();
  Vec3 left_at = hit.position;
  const auto sample = this->sample(surface, walk, encounter, light, left_at, rng);
  if (!sample) {
    sums.energy[scene_.energy.absorbed_bin(encounter.part)] += walk.weight.y();
    return false;
  }
  const bool crosses = k_before * sample->light.frame.k.z() > 0.0;
  next_event_.leave(walk.coverage, meeting, estimated, sample->specular);
  photon.light = upright ? sample->light : to_world(surface, sample->light);
  if (++walk.events % kEventsPerRenormalization == 0) renormalize(photon.light.frame);
  if (!std::isfinite(photon.light.frame.k.sum() + photon.light.Q + photon.light.U + photon.light.V)) {
    sums.energy[scene_.energy.lost_bin(LossReason::kInvalid)] += 1.0;
    return false;
  }
  walk.corner = hit.distance <= kSamePoint ? photon.quad : -1;
  photon.position = left_at;
  photon.quad = hit.quad;
  if (surface.body >= 0 && crosses) photon.body = photon.body >= 0 ? -1 : surface.body;
  return true;
}

}  // namespace evenglow::tracer

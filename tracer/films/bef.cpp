#include "tracer/films/bef.h"

#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

// Turns about the groove, x, between the film's frame and that of a face with the normal (0, ny, nz) as its z.
// Made anew component by component: a copy whose frame is then overwritten waits for the stores of its maker.
Vec3 to_face(const Vec3& v, double ny, double nz) {
  return {v.x(), nz * v.y() - ny * v.z(), ny * v.y() + nz * v.z()};
}

Vec3 from_face(const Vec3& v, double ny, double nz) {
  return {v.x(), nz * v.y() + ny * v.z(), nz * v.z() - ny * v.y()};
}

StokesVector to_face(const StokesVector& s, double ny, double nz) {
  return {s.I, s.Q, s.U, s.V, {to_face(s.frame.k, ny, nz), to_face(s.frame.e1, ny, nz)}};
}

StokesVector from_face(const StokesVector& s, double ny, double nz) {
  return {s.I, s.Q, s.U, s.V, {from_face(s.frame.k, ny, nz), from_face(s.frame.e1, ny, nz)}};
}

}  // namespace

/// Light on its way through the film, in the film's frame: x along the grooves, z from the flat face to the prisms.
struct PrismFilm::Walk {
  enum class Place { kPrism, kGroove, kLeft, kAbsorbed };

  StokesVector light;
  Place place = Place::kPrism;
  PrismPoint point;
  PrismPart part = PrismPart::kNone;  ///< the face that it leaves
  double optical_depth = 0.0;         ///< that it has left to go
  int facets = 0;
  int base_faces = 0;

  const Vec3& k() const { return light.frame.k; }
};

PrismFilm::PrismFilm(const PrismFilmSpec& spec)
    : spec_(spec),
      profile_(spec.profile),
      base_(1.0, spec.refractive_index),
      facet_(spec.refractive_index, 1.0),
      cos_(std::cos(spec.axis)),
      sin_(std::sin(spec.axis)),
      flip_(spec.inverted ? -1.0 : 1.0) {
  core::expects(spec.refractive_index > 1.0 && spec.base >= 0.0 && spec.absorption >= 0.0,
                "a prism film has an index above 1, and base and absorption are not negative");
}

StokesVector PrismFilm::to_film(const StokesVector& s) const {
  const auto turn = [this](const Vec3& v) {
    return Vec3(cos_ * v.x() + sin_ * v.y(), flip_ * (cos_ * v.y() - sin_ * v.x()), flip_ * v.z());
  };
  return {s.I, s.Q, s.U, s.V, {turn(s.frame.k), turn(s.frame.e1)}};
}

StokesVector PrismFilm::from_film(const StokesVector& s) const {
  const auto turn = [this](const Vec3& v) {
    const double across = flip_ * v.y();
    return Vec3(cos_ * v.x() - sin_ * across, sin_ * v.x() + cos_ * across, flip_ * v.z());
  };
  return {s.I, s.Q, s.U, s.V, {turn(s.frame.k), turn(s.frame.e1)}};
}

void PrismFilm::start(const StokesVector& incident, core::PhotonRng& rng, Walk& walk) const {
  walk.light = to_film(incident);
  walk.optical_depth = spec_.absorption > 0.0 ? -std::log(rng.uniform()) : std::numeric_limits<double>::infinity();
  walk.point.y = (rng.uniform() - 0.5) * profile_.pitch();
  if (walk.k().z() <= 0.0) {
    walk.point.z = profile_.height();
    walk.place = Walk::Place::kGroove;
    return;
  }
  walk.base_faces = 1;
  walk.light = base_.sample(walk.light, rng)->light;
  if (walk.k().z() <= 0.0) {
    walk.place = Walk::Place::kLeft;
    return;
  }
  walk.optical_depth -= spec_.absorption * spec_.base / walk.k().z();
}

void PrismFilm::visit_base(Walk& walk, core::PhotonRng& rng) const {
  const double path = spec_.base / -walk.k().z();
  walk.optical_depth -= spec_.absorption * path;
  if (walk.optical_depth <= 0.0) return;
  ++walk.base_faces;
  walk.light = base_.sample(walk.light, rng)->light;
  if (walk.k().z() < 0.0) {
    walk.place = Walk::Place::kLeft;
    return;
  }
  walk.optical_depth -= spec_.absorption * path;
  walk.point = {profile_.wrapped(walk.point.y + 2.0 * path * walk.k().y()), 0.0};
  walk.part = PrismPart::kNone;
}

void PrismFilm::meet_facet(const PrismHit& hit, Walk& walk, core::PhotonRng& rng) const {
  ++walk.facets;
  const StokesVector light = to_face(walk.light, hit.normal_y, hit.normal_z);
  const BsdfSample sample = *facet_.sample(light, rng);
  walk.light = from_face(sample.light, hit.normal_y, hit.normal_z);
  walk.point = hit.point;
  walk.part = hit.part;
  if (light.frame.k.z() * sample.light.frame.k.z() < 0.0) return;
  const bool out = walk.place == Walk::Place::kPrism;
  walk.place = out ? Walk::Place::kGroove : Walk::Place::kPrism;
  walk.point = out ? profile_.from_prism_to_groove(hit.point, hit.normal_y)
                   : profile_.from_groove_to_prism(hit.point, hit.normal_y);
}

void PrismFilm::cross_prism(Walk& walk, core::PhotonRng& rng) const {
  const PrismHit hit = profile_.inside(walk.point, walk.k().y(), walk.k().z(), walk.part);
  walk.optical_depth -= spec_.absorption * hit.distance;
  if (walk.optical_depth > 0.0) {
    if (hit.part != PrismPart::kOpen) {
      meet_facet(hit, walk, rng);
      return;
    }
    walk.point = hit.point;
    visit_base(walk, rng);
  }
  if (walk.optical_depth <= 0.0) walk.place = Walk::Place::kAbsorbed;
}

void PrismFilm::cross_groove(Walk& walk, core::PhotonRng& rng) const {
  const PrismHit hit = profile_.outside(walk.point, walk.k().y(), walk.k().z(), walk.part);
  if (hit.part == PrismPart::kOpen) {
    walk.place = Walk::Place::kLeft;
  } else {
    meet_facet(hit, walk, rng);
  }
}

PrismPass PrismFilm::trace(const StokesVector& incident, core::PhotonRng& rng) const {
  Walk walk;
  start(incident, rng, walk);
  for (int i = 0; i < kMaxEvents && walk.place < Walk::Place::kLeft; ++i) {
    if (walk.place == Walk::Place::kPrism) {
      cross_prism(walk, rng);
    } else {
      cross_groove(walk, rng);
    }
  }
  if (walk.place != Walk::Place::kLeft) return {std::nullopt, walk.facets, walk.base_faces};
  return {from_film(walk.light), walk.facets, walk.base_faces};
}

std::optional<BsdfSample> PrismFilm::sample(const StokesVector& incident, core::PhotonRng& rng) const {
  const PrismPass pass = trace(incident, rng);
  if (!pass.light) return std::nullopt;
  return BsdfSample{*pass.light, true};
}

StokesVector PrismFilm::evaluate(const StokesVector&, const Vec3& k_out) const {
  return StokesVector::unpolarized(0.0, tangential_frame(k_out).frame);
}

}  // namespace evenglow::tracer

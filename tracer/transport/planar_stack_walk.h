#pragma once

#include <cmath>

#include "core/math/lambertian.h"
#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_diffuser.h"
#include "tracer/transport/planar_layers.h"
#include "tracer/transport/planar_plate_state.h"

namespace evenglow::tracer {

/// The part of a walk that is spent in the air below and above the plate, from layer to layer: the light stays in the
/// meridian frame, and each flight ends at the next layer or the one before.
template <typename Light>
class PlanarStackWalk {
 public:
  using Walk = PhotonHistory::Walk;
  enum class End {
    kAtPlate,    ///< the light of the state has come to a face of the plate, `side`
    kElsewhere,  ///< the photon has it, to be followed otherwise
    kEnded       ///< absorbed or escaped
  };

  PlanarStackWalk(PlanarPlateState<Light>& state, const PlanarLayers& layers, const PhotonHistory& history,
                  const Scene& scene)
      : s_(state), layers_(layers), history_(history), scene_(scene), estimates_(history.next_event().active()) {}

  /// From the face of the plate at which the state's light is, in air.
  End run(int face, Walk& walk, PlanarProgress& progress, core::PhotonRng& rng, BatchSums& sums) {
    at_ = layers_.plate_face(face);
    walk.photon.body = -1;
    walk.corner = -1;
    while (progress.events < PhotonHistory::kMaxEvents) {
      const bool upward = s_.light.kz > 0.0;
      if (upward && layers_[at_].last) return escape(walk, progress, sums);
      if (!fly(upward)) break;
      ++progress.events;
      const PlanarLayer& layer = layers_[at_];
      switch (layer.kind) {
        case PlanarLayer::Kind::kPlate:
          return End::kAtPlate;
        case PlanarLayer::Kind::kReflector:
          if (!meet_reflector(layer, walk, rng, sums)) return absorbed(layer, walk, sums);
          break;
        case PlanarLayer::Kind::kDiffuser:
          if (!meet_diffuser(layer, walk, rng, sums)) return absorbed(layer, walk, sums);
          break;
        case PlanarLayer::Kind::kPrism:
          tell(layer, walk, sums);
          if (!layer.prism->pass(s_.light, walk.optical_depth, rng)) return absorbed(layer, walk, sums);
          told(layer, walk, true);
          break;
        case PlanarLayer::Kind::kOther:
          if (!meet_other(layer, walk, rng, sums)) return End::kEnded;
          if (walk.photon.body >= 0) return End::kElsewhere;
          break;
      }
    }
    s_.leave(walk.photon, layers_[at_].quad, s_.light.stokes());
    return End::kElsewhere;
  }

  /// Of the plate, and how far (mm) the light has come to it.
  int side() const { return at_ == layers_.plate_face(4) ? 4 : 5; }
  double distance() const { return distance_; }

 private:
  /// To the next layer; false, and nothing done, if something else may be met on the way.
  bool fly(bool upward) {
    if (!upward && at_ == 0) return false;
    const PlanarLayer& lower = layers_[upward ? at_ : at_ - 1];
    if (!lower.air_above) return false;
    const std::size_t next = upward ? at_ + 1 : at_ - 1;
    const double distance = (layers_[next].z - s_.z) / s_.light.kz;
    const double x = s_.x + distance * s_.light.kx;
    const double y = s_.y + distance * s_.light.ky;
    const auto inside = [&lower](double a, double b) {
      return a > lower.min_x && a < lower.max_x && b > lower.min_y && b < lower.max_y;
    };
    // Both ends: a film may be larger than the plate, and what stands beside that is not known here.
    if (!inside(x, y) || !inside(s_.x, s_.y)) return false;
    s_.x = x;
    s_.y = y;
    s_.z = layers_[next].z;
    distance_ = distance;
    at_ = next;
    return true;
  }

  End escape(Walk& walk, PlanarProgress& progress, BatchSums& sums) {
    ++progress.events;
    const core::Vec3 position = s_.position();
    const core::Vec3 k(s_.light.kx, s_.light.ky, s_.light.kz);
    if (s_.z >= scene_.box.max.z()) {
      const bool estimated = estimates_ && history_.next_event().covers(walk.coverage, position);
      history_.escape(walk, {Side::kTop, position, k, estimated}, sums);
    } else {
      walk.photon.position = position;
      walk.photon.light.frame.k = k;
      history_.escape(walk, sums);
    }
    return End::kEnded;
  }
  End absorbed(const PlanarLayer& layer, const Walk& walk, BatchSums& sums) const {
    sums.energy[scene_.energy.absorbed_bin(layer.part)] += walk.weight.y();
    return End::kEnded;
  }

  bool meet_reflector(const PlanarLayer& layer, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
    tell(layer, walk, sums);
    const double u = rng.uniform();
    if (u >= layer.reflector.reflectance) return false;
    Light& k = s_.light;
    const bool mirrored = u < layer.reflector.mirrored;
    if (mirrored) {
      k.mirror();
      k.kz = -k.kz;
    } else {
      const core::Vec3 out = core::draw_lambertian(rng, layer.reflector.again(u));
      k.forget_polarization();
      k.kx = out.x();
      k.ky = out.y();
      k.kz = std::copysign(out.z(), -k.kz);
    }
    told(layer, walk, mirrored);
    return true;
  }

  bool meet_diffuser(const PlanarLayer& layer, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
    tell(layer, walk, sums);
    const DiffuserEnd end = pass_diffuser(*layer.diffuser, s_.light, rng);
    if (end == DiffuserEnd::kAbsorbed) return false;
    told(layer, walk, end == DiffuserEnd::kStraight);
    return true;
  }

  bool meet_other(const PlanarLayer& layer, Walk& walk, core::PhotonRng& rng, BatchSums& sums) {
    walk.photon.light = s_.light.stokes();
    if (!history_.interact(walk, {layer.quad, distance_, s_.position()}, rng, sums)) return false;
    walk.corner = -1;
    if (walk.photon.body < 0) s_.light = Light(walk.photon.light);
    return true;
  }

  /// `NextEvent` before and after a meeting.
  void tell(const PlanarLayer& layer, Walk& walk, BatchSums& sums) {
    if (!estimates_) return;
    // All but the side that the light comes from counts for optics alone that scatter as they are lit.
    const bool in_full = layer.kind == PlanarLayer::Kind::kDiffuser;
    incident_ = in_full ? s_.light.stokes() : core::StokesVector{1.0, 0.0, 0.0, 0.0, {}};
    if (!in_full) incident_.frame.k.z() = in_surface(layer, walk) * s_.light.kz;
    position_ = s_.position();
    estimated_ = history_.next_event().meet(
        walk.coverage, {layer.quad, *layer.optics, incident_, position_, walk.band, walk.weight, walk.told}, sums);
  }
  void told(const PlanarLayer& layer, Walk& walk, bool specular) const {
    if (!estimates_) return;
    history_.next_event().leave(walk.coverage,
                                {layer.quad, *layer.optics, incident_, position_, walk.band, walk.weight, walk.told},
                                estimated_, specular);
  }
  double in_surface(const PlanarLayer& layer, const Walk& walk) const {
    return scene_.optics[walk.band].surfaces[static_cast<std::size_t>(layer.quad)].normal.z();
  }

  PlanarPlateState<Light>& s_;
  const PlanarLayers& layers_;
  const PhotonHistory& history_;
  const Scene& scene_;
  bool estimates_;
  std::size_t at_ = 0;
  double distance_ = 0.0;
  core::StokesVector incident_{1.0, 0.0, 0.0, 0.0, {}};
  core::Vec3 position_ = core::Vec3::Zero();
  bool estimated_ = false;
};

}  // namespace evenglow::tracer

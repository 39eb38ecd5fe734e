#pragma once

#include <cmath>

#include "tracer/transport/planar_plate_state.h"

namespace evenglow::tracer {

/// The smooth bottom or top of the plate, between it and air. The state's light has come to it and lies on its plane;
/// it is reflected, or passes with the odds of its own polarization.
template <typename Light>
class PlanarFace {
 public:
  PlanarFace(PlanarPlateState<Light>& state, int side) : s_(state), side_(side) {}

  /// Light from inside: does it get out, into air?
  bool gets_out(core::PhotonRng& rng) {
    Light& k = s_.light;
    const PlateFresnel face = s_.face();
    if (face.reflects(k, rng)) {
      k.kz = -k.kz;
      return false;
    }
    const double n = s_.plate.refractive_index;
    face.pass(k);
    k.kx *= n;
    k.ky *= n;
    k.kz = std::copysign(face.cos_t, k.kz);
    s_.clamp_into_plate();
    return true;
  }
  /// The same; then the photon has it.
  bool lets_out(Photon& photon, core::PhotonRng& rng) {
    if (!gets_out(rng)) return false;
    leave(photon);
    return true;
  }

  /// Light from air: does it get in?
  bool gets_in(core::PhotonRng& rng) {
    Light& k = s_.light;
    const PlateFresnel face(std::abs(k.kz), s_.plate.per_index);
    if (face.reflects(k, rng)) {
      k.kz = -k.kz;
      return false;
    }
    face.pass(k);
    k.kx *= s_.plate.per_index;
    k.ky *= s_.plate.per_index;
    k.kz = std::copysign(face.cos_t, k.kz);
    s_.turned();
    return true;
  }
  /// The same; if not, the photon has it again.
  bool lets_in(Photon& photon, core::PhotonRng& rng) {
    if (gets_in(rng)) return true;
    leave(photon);
    return false;
  }

 private:
  void leave(Photon& photon) const {
    s_.leave(photon, s_.plate.quads[static_cast<std::size_t>(side_)], s_.light.stokes());
  }

  PlanarPlateState<Light>& s_;
  int side_;
};

}  // namespace evenglow::tracer

#pragma once

#include "core/light/stokes.h"
#include "core/math/vec3.h"

namespace evenglow::tracer {

/// A photon packet on its way; it carries 1 / photons of the emitted flux, all of it or nothing.
struct Photon {
  core::Vec3 position = core::Vec3::Zero();          ///< mm
  core::StokesVector light{1.0, 0.0, 0.0, 0.0, {}};  ///< I = 1; direction in light.frame.k
  int quad = -1;                                     ///< the quad that it leaves; -1: none
  int body = -1;                                     ///< the dielectric body that it is in; -1: air
};

}  // namespace evenglow::tracer

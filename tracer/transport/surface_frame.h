#pragma once

#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// Vectors and light between the backlight's axes and those of a surface.
inline core::Vec3 to_local(const Surface& surface, const core::Vec3& v) {
  return {surface.x.dot(v), surface.y.dot(v), surface.normal.dot(v)};
}

inline core::Vec3 to_world(const Surface& surface, const core::Vec3& v) {
  return v.x() * surface.x + v.y() * surface.y + v.z() * surface.normal;
}

/// Are its axes those of the backlight, as of every film and reflector that lies in it? Then light needs no turn.
inline bool is_upright(const Surface& surface) {
  return surface.normal.z() == 1.0 && surface.x.x() == 1.0;
}

// Made anew component by component: a copy whose frame is then overwritten waits for the stores of its maker.
inline core::StokesVector to_local(const Surface& surface, const core::StokesVector& s) {
  return {s.I, s.Q, s.U, s.V, {to_local(surface, s.frame.k), to_local(surface, s.frame.e1)}};
}

inline core::StokesVector to_world(const Surface& surface, const core::StokesVector& s) {
  return {s.I, s.Q, s.U, s.V, {to_world(surface, s.frame.k), to_world(surface, s.frame.e1)}};
}

}  // namespace evenglow::tracer

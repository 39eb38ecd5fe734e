#pragma once

#include "core/light/stokes.h"

namespace evenglow::tracer {

/// How a bump stands on a face: between the frame of the surface (+z out of the plate) and that of the bump (z from its
/// footprint to its top, x across the ridge of a v_groove). A sunk structure is a bump of air that grows into the
/// plate: the same body after half a turn about its x axis. Proper rotations only, so polarization keeps its
/// handedness.
class BumpPlacement {
 public:
  enum class Form { kRaised, kSunk };

  /// `axis` (rad): direction of the ridge, from the +x of the backlight towards its +y as seen by the viewer; the
  /// bump's x is that direction turned back by 90 degrees. `on_top`: on the plate's top face. (On the bottom face the
  /// surface's own y runs against that of the backlight.)
  BumpPlacement(Form form, double axis, bool on_top);

  bool sunk() const { return flip_ < 0.0; }
  /// Whether the bump grows along the backlight's z (1) or against it, with its y against the backlight's (-1).
  double growth() const { return on_top_ != sunk() ? 1.0 : -1.0; }

  core::Vec3 into_bump(const core::Vec3& v) const {
    return {x_x_ * v.x() + x_y_ * v.y(), flip_ * (x_x_ * v.y() - x_y_ * v.x()), flip_ * v.z()};
  }
  core::Vec3 out_of_bump(const core::Vec3& v) const {
    const double y = flip_ * v.y();
    return {x_x_ * v.x() - x_y_ * y, x_y_ * v.x() + x_x_ * y, flip_ * v.z()};
  }
  core::StokesVector into_bump(const core::StokesVector& s) const {
    return {s.I, s.Q, s.U, s.V, {into_bump(s.frame.k), into_bump(s.frame.e1)}};
  }
  core::StokesVector out_of_bump(const core::StokesVector& s) const {
    return {s.I, s.Q, s.U, s.V, {out_of_bump(s.frame.k), out_of_bump(s.frame.e1)}};
  }

 private:
  double x_x_, x_y_;  ///< the bump's x axis in the frame of the surface
  double flip_;       ///< -1: sunk
  bool on_top_;
};

}  // namespace evenglow::tracer

#pragma once

#include <limits>

namespace evenglow::tracer {

/// Where a line p + t k lies in a convex body: t from `enter` to `leave`, and the faces that it crosses there. Empty if
/// enter >= leave.
struct RaySpan {
  /// The face of every bump that is its footprint, in the plane z = 0.
  static constexpr int kFootprint = 0;

  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int enter_face = -1;
  int leave_face = -1;

  /// Keeps the part on the inner side of a plane: `distance` of p from it (positive inside), `slope` = k . normal
  /// (outward).
  void cut(double distance, double slope, int face) {
    if (slope > 0.0) {
      const double t = distance / slope;
      if (t < leave) leave = t, leave_face = face;
    } else if (slope < 0.0) {
      const double t = distance / slope;
      if (t > enter) enter = t, enter_face = face;
    } else if (distance < 0.0) {
      leave = -std::numeric_limits<double>::infinity();
    }
  }
};

}  // namespace evenglow::tracer

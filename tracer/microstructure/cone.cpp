#include "tracer/microstructure/cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracer/microstructure/bump_keys.h"

namespace evenglow::tracer {

using core::Vec3;

ConicBump::ConicBump(double flank, double truncation, double fill)
    : cell_(fill),
      apex_(std::tan(flank)),
      height_(apex_ * (1.0 - truncation)),
      sin_flank_(std::sin(flank)),
      cos_flank_(std::cos(flank)) {}

void ConicBump::cut_flank(const Vec3& p, const Vec3& k, RaySpan& span) const {
  // f(t) = apex^2 (x^2 + y^2) - (apex - z)^2 <= 0: the double cone; the slab from footprint to top keeps the lower one.
  const double apex2 = apex_ * apex_;
  const double below = apex_ - p.z();
  const double a = apex2 * (k.x() * k.x() + k.y() * k.y()) - k.z() * k.z();
  const double b = apex2 * (p.x() * k.x() + p.y() * k.y()) + below * k.z();
  const double c = apex2 * (p.x() * p.x() + p.y() * p.y()) - below * below;
  const double root2 = b * b - a * c;
  if (root2 <= 0.0 && a > 0.0) {
    span.leave = span.enter;
    span.leave_face = kFlank;  // of light that grazes it from inside
    return;
  }
  const double q = -(b + std::copysign(std::sqrt(std::max(0.0, root2)), b));
  const double t1 = a != 0.0 ? q / a : -std::copysign(std::numeric_limits<double>::infinity(), q);
  const double t2 = q != 0.0 ? c / q : t1;
  if (a > 0.0) {
    span = {std::min(t1, t2), std::max(t1, t2), kFlank, kFlank};
  } else if (k.z() > 0.0) {  // steeper than the flank: up and out, or down and in
    span.leave = std::min(t1, t2);
    span.leave_face = kFlank;
  } else {
    span.enter = std::max(t1, t2);
    span.enter_face = kFlank;
  }
}

RaySpan ConicBump::span(const Vec3& p, const Vec3& k) const {
  RaySpan span;
  cut_flank(p, k, span);
  span.cut(height_ - p.z(), k.z(), kTop);
  span.cut(p.z(), -k.z(), RaySpan::kFootprint);
  return span;
}

Vec3 ConicBump::normal(int face, const Vec3& p) const {
  if (face == RaySpan::kFootprint) return -Vec3::UnitZ();
  const double radius = std::hypot(p.x(), p.y());
  if (face == kTop || radius == 0.0) return Vec3::UnitZ();
  return {sin_flank_ * p.x() / radius, sin_flank_ * p.y() / radius, cos_flank_};
}

double ConicBump::top(double distance) const {
  return std::min(height_, apex_ * (1.0 - distance));
}

Microstructure make_cone(const core::ConfigNode& node) {
  const BumpPlacement placement = read_placement(node);
  const Flank flank = read_flank(node);
  const double fill = read_fill(node, kRoundFill);
  return bump_of("cone", ConicBump(flank.angle, flank.truncation, fill), placement, fill);
}

}  // namespace evenglow::tracer

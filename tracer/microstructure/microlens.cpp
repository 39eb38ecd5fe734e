#include "tracer/microstructure/microlens.h"

#include <cmath>

#include "tracer/microstructure/bump_keys.h"

namespace evenglow::tracer {

using core::Vec3;

SphericalCap::SphericalCap(double aspect, double fill)
    : cell_(fill), height_(2.0 * aspect), depth_((1.0 - height_) * (1.0 + height_) / (2.0 * height_)) {}

RaySpan SphericalCap::span(const Vec3& p, const Vec3& k) const {
  // |p + t k - center|^2 = radius^2, written so that nothing large cancels: radius^2 = depth^2 + 1.
  const double b = p.dot(k) + depth_ * k.z();
  const double c = p.x() * p.x() + p.y() * p.y() - 1.0 + p.z() * (p.z() + 2.0 * depth_);
  const double root2 = b * b - c;
  RaySpan span;
  if (root2 <= 0.0) {
    span.leave = span.enter;
    span.leave_face = 1;  // of light that grazes it from inside
    return span;
  }
  const double q = -(b + std::copysign(std::sqrt(root2), b));
  const double other = c / q;
  span.enter = std::min(q, other);
  span.leave = std::max(q, other);
  span.enter_face = span.leave_face = 1;
  span.cut(p.z(), -k.z(), RaySpan::kFootprint);
  return span;
}

Vec3 SphericalCap::normal(int face, const Vec3& p) const {
  if (face == RaySpan::kFootprint) return -Vec3::UnitZ();
  return Vec3(p.x(), p.y(), p.z() + depth_).normalized();
}

double SphericalCap::top(double distance) const {
  // sqrt(radius^2 - d^2) - depth
  const double chord2 = (1.0 - distance) * (1.0 + distance);
  return chord2 / (std::sqrt(depth_ * depth_ + chord2) + depth_);
}

Microstructure make_microlens(const core::ConfigNode& node) {
  const BumpPlacement placement = read_placement(node);
  const double aspect = node.number({"aspect", "height over diameter", core::Range::closed(1e-4, 0.5), 0.2});
  const double fill = read_fill(node, kRoundFill);
  return bump_of("microlens", SphericalCap(aspect, fill), placement, fill);
}

}  // namespace evenglow::tracer

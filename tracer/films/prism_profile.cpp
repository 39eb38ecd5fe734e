#include "tracer/films/prism_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Share of the pitch by which facets and arc overlap where they join, so that rounding leaves no hole.
constexpr double kOverlap = 1e-9;

}  // namespace

PrismProfile::PrismProfile(const Shape& shape)
    : half_pitch_(0.5 * shape.pitch),
      normal_y_(std::cos(0.5 * shape.apex)),
      normal_z_(std::sin(0.5 * shape.apex)),
      offset_(half_pitch_ * normal_y_),
      flat_(0.5 * shape.tip_flat),
      radius_(shape.tip_radius) {
  core::expects(shape.pitch > 0.0 && shape.apex > 0.0 && shape.apex < core::kPi, "a prism has a pitch and an apex");
  core::expects(flat_ >= 0.0 && radius_ >= 0.0 && (flat_ == 0.0 || radius_ == 0.0), "a tip is flat or round");
  const double half_tip = flat_ > 0.0 ? flat_ : radius_ * normal_y_;
  core::expects(half_tip < half_pitch_, "a tip is narrower than its prism");
  shoulder_ = (half_pitch_ - half_tip) * normal_y_ / normal_z_;
  height_ = shoulder_ + radius_ * (1.0 - normal_z_);
  center_z_ = height_ - radius_;
}

PrismHit PrismProfile::facet_hit(PrismPart part, double distance, const PrismPoint& from, double dy, double dz) const {
  const double t = std::max(0.0, distance);
  const double side = part == PrismPart::kRight ? 1.0 : -1.0;
  return {part, t, {from.y + t * dy, std::clamp(from.z + t * dz, 0.0, shoulder_)}, side * normal_y_, normal_z_};
}

PrismHit PrismProfile::open_hit(double level, const PrismPoint& from, double dy, double dz) const {
  const double t = dz != 0.0 ? std::max(0.0, (level - from.z) / dz) : 0.0;
  return {PrismPart::kOpen, t, {from.y + t * dy, level}, 0.0, 1.0};
}

PrismHit PrismProfile::arc_hit(double distance, double center_y, const PrismPoint& from, double dy, double dz) const {
  const double t = std::max(0.0, distance);
  const double y = from.y + t * dy - center_y;
  const double z = from.z + t * dz - center_z_;
  const double scale = 1.0 / std::hypot(y, z);
  const double ny = y * scale, nz = z * scale;
  return {PrismPart::kTip, t, {center_y + radius_ * ny, center_z_ + radius_ * nz}, ny, nz};
}

PrismHit PrismProfile::inside(const PrismPoint& from, double dy, double dz, PrismPart skip) const {
  // The cell is convex: the ray leaves by the nearest of the lines that it runs against.
  const double to_right = normal_y_ * dy + normal_z_ * dz;
  const double to_left = -normal_y_ * dy + normal_z_ * dz;
  const double height = offset_ - normal_z_ * from.z;
  double nearest = kNever;
  PrismPart part = PrismPart::kOpen;
  if (to_right > 0.0 && skip != PrismPart::kRight) {
    nearest = (height - normal_y_ * from.y) / to_right;
    part = PrismPart::kRight;
  }
  if (to_left > 0.0 && skip != PrismPart::kLeft) {
    const double t = (height + normal_y_ * from.y) / to_left;
    if (t < nearest) {
      nearest = t;
      part = PrismPart::kLeft;
    }
  }
  if (dz < 0.0 && -from.z / dz < nearest) return open_hit(0.0, from, dy, dz);
  if (dz > 0.0 && flat_ > 0.0 && skip != PrismPart::kTip && (height_ - from.z) / dz < nearest) {
    PrismHit hit = open_hit(height_, from, dy, dz);
    hit.part = PrismPart::kTip;
    return hit;
  }
  if (part == PrismPart::kOpen) return open_hit(0.0, from, dy, dz);
  if (radius_ > 0.0 && from.z + nearest * dz > shoulder_) {
    // The facet's line is met beyond the facet, so the arc was met before: the farther root, the disc being inside.
    const double b = dy * from.y + dz * (from.z - center_z_);
    const double c = from.y * from.y + (from.z - center_z_) * (from.z - center_z_) - radius_ * radius_;
    const double d2 = dy * dy + dz * dz;
    const double root2 = b * b - d2 * c;
    if (root2 > 0.0) return arc_hit((std::sqrt(root2) - b) / d2, 0.0, from, dy, dz);
  }
  return facet_hit(part, nearest, from, dy, dz);
}

void PrismProfile::meet_outer_facet(PrismPart part, const PrismPoint& from, double dy, double dz,
                                    PrismHit& best) const {
  const double ny = part == PrismPart::kRight ? normal_y_ : -normal_y_;
  const double slope = ny * dy + normal_z_ * dz;
  if (slope >= 0.0) return;
  const double t = -(ny * from.y + normal_z_ * from.z) / slope;
  const double slack = kOverlap * half_pitch_;
  if (radius_ > 0.0 && (from.z + t * dz > shoulder_ + slack || t < -slack)) return;
  if (t < best.distance) best = facet_hit(part, t, from, dy, dz);
}

void PrismProfile::meet_outer_arc(double center_y, const PrismPoint& from, double dy, double dz, PrismHit& best) const {
  const double y = from.y - center_y;
  const double z = from.z - center_z_;
  const double b = dy * y + dz * z;
  const double d2 = dy * dy + dz * dz;
  const double root2 = b * b - d2 * (y * y + z * z - radius_ * radius_);
  if (b >= 0.0 || root2 < 0.0) return;
  const double t = (-b - std::sqrt(root2)) / d2;
  if (t >= best.distance || from.z + t * dz < shoulder_ - kOverlap * half_pitch_) return;
  best = arc_hit(t, center_y, from, dy, dz);
}

PrismHit PrismProfile::outside(const PrismPoint& from, double dy, double dz, PrismPart skip) const {
  if (dz >= 0.0 && from.z >= height_) return open_hit(height_, from, dy, dz);
  if (from.z >= height_ && std::abs(from.y) > half_pitch_ - flat_) return {PrismPart::kTip, 0.0, from, 0.0, 1.0};
  PrismHit best;
  best.distance = kNever;
  if (dz > 0.0) best = open_hit(height_, from, dy, dz);
  // The groove's left wall is the right facet of the prism at its left, its right wall the left facet of the next one.
  if (skip != PrismPart::kRight) meet_outer_facet(PrismPart::kRight, from, dy, dz, best);
  if (skip != PrismPart::kLeft) meet_outer_facet(PrismPart::kLeft, from, dy, dz, best);
  if (radius_ > 0.0) {
    // A convex arc cannot be met again by what leaves it, but the other one can.
    if (skip != PrismPart::kTip || from.y > 0.0) meet_outer_arc(-half_pitch_, from, dy, dz, best);
    if (skip != PrismPart::kTip || from.y < 0.0) meet_outer_arc(half_pitch_, from, dy, dz, best);
  }
  if (best.part != PrismPart::kNone) return best;
  // Only rounding in a corner leads here: the wall that the ray is headed for.
  return facet_hit(dy < 0.0 ? PrismPart::kRight : PrismPart::kLeft, 0.0, from, dy, dz);
}

PrismPoint PrismProfile::from_prism_to_groove(const PrismPoint& point, double normal_y) const {
  return {wrapped(point.y + (normal_y > 0.0 ? -half_pitch_ : half_pitch_)), point.z};
}

PrismPoint PrismProfile::from_groove_to_prism(const PrismPoint& point, double normal_y) const {
  return {wrapped(point.y + (normal_y > 0.0 ? half_pitch_ : -half_pitch_)), point.z};
}

double PrismProfile::wrapped(double y) const {
  const double pitch = 2.0 * half_pitch_;
  if (std::abs(y) <= half_pitch_) return y;
  return y - pitch * std::floor(y / pitch + 0.5);
}

}  // namespace evenglow::tracer

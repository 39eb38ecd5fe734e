#include "tracer/receivers/luminance_receiver.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/sampling.h"

namespace evenglow::tracer {

bool Pupil::sees(const core::Vec3& position, const core::Vec3& k) const {
  if (k.z() <= 0.0) return false;
  const core::Vec3 met = position + (center.z() - position.z()) / k.z() * k;
  return (met - center).squaredNorm() <= radius * radius;
}

double Pupil::projected_solid_angle(const core::Vec3& position) const {
  const double h2 = std::pow(center.z() - position.z(), 2);
  const double r2 = radius * radius;
  const double a2 = std::pow(center.x() - position.x(), 2) + std::pow(center.y() - position.y(), 2);
  const double x = a2 + h2 - r2;
  const double s = std::sqrt(x * x + 4.0 * r2 * h2);
  // pi/2 (1 - x/s); for a small pupil without the difference of nearly equal numbers.
  return x > 0.0 ? 2.0 * core::kPi * r2 * h2 / (s * (s + x)) : 0.5 * core::kPi * (1.0 - x / s);
}

LuminanceReceiver::LuminanceReceiver(const core::CellGrid& cells, double cone, double polar, double azimuth)
    : LuminanceReceiver(cells, cone, {ViewDirection{polar, azimuth, 1.0}}) {}

LuminanceReceiver::LuminanceReceiver(const core::CellGrid& cells, double cone,
                                     const std::vector<ViewDirection>& directions)
    : cells_(cells), sin_cone_(std::sin(cone)) {
  double shares = 0.0, farthest = 0.0;
  for (const ViewDirection& d : directions) {
    core::expects(d.share > 0.0 && d.polar >= 0.0, "shares above 0, polar angles not below 0");
    shares += d.share;
    farthest = std::max(farthest, d.polar);
  }
  core::expects(std::abs(shares - 1.0) < 1e-9, "directions of view with shares that sum to 1");
  core::expects(cone >= 0.0 && farthest + cone <= 0.5 * core::kPi + 1e-12 && farthest < 0.5 * core::kPi,
                "0 <= cone <= 90 degrees, none of it below the horizon");
  const double counted = cone < kLeastCountedCone ? std::min(kWideCountedCone, 0.5 * core::kPi - farthest) : cone;
  sin_counted_ = std::sin(counted);
  cos_counted_ = std::cos(counted);
  for (const auto& [polar, azimuth, share] : directions) {
    const core::Vec3 side(-std::sin(azimuth), std::cos(azimuth), 0.0);
    const core::Vec3 up(-std::cos(polar) * std::cos(azimuth), -std::cos(polar) * std::sin(azimuth), std::sin(polar));
    const core::Vec3 axis(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    double weight = 1.0 / (core::kPi * sin_counted_ * sin_counted_);
    if (polar > 0.0) weight /= axis.z();
    cones_.push_back({polar > 0.0, side, up, axis, share * weight, share});
  }
}

LuminanceReceiver::LuminanceReceiver(const core::CellGrid& cells, const Pupil& pupil)
    : LuminanceReceiver(cells, 0.5 * core::kPi) {
  core::expects(pupil.radius > 0.0 && pupil.center.z() > pupil.display_z, "a pupil above the display");
  pupil_ = pupil;
}

bool LuminanceReceiver::sees(const core::Vec3& k, const Cone& cone) const {
  if (cone.tilted) return k.dot(cone.axis) >= cos_counted_;
  return k.x() * k.x() + k.y() * k.y() <= sin_counted_ * sin_counted_;
}

View LuminanceReceiver::sample_pupil(const core::Vec3& position, double u1, double u2, double aside) const {
  const double to_center = std::hypot(pupil_->center.x() - position.x(), pupil_->center.y() - position.y());
  const double height = pupil_->center.z() - position.z();
  // A sheet takes light less far aside than the straight way: by at most depth x tan(polar angle), so that light which
  // aims past the pupil by no more than that may come in.
  const double depth = std::fmax(0.0, pupil_->display_z - position.z());
  const double reach = pupil_->radius + aside + depth * (to_center + pupil_->radius) / (height - depth);
  const double r = reach * std::sqrt(u1);
  const double phi = 2.0 * core::kPi * u2;
  const core::Vec3 way = pupil_->center + r * core::Vec3(std::cos(phi), std::sin(phi), 0.0) - position;
  const double d2 = way.squaredNorm();
  // k_z d(solid angle) = h^2 / d^4 d(area)
  return {way / std::sqrt(d2), core::kPi * reach * reach * height * height / (d2 * d2)};
}

View LuminanceReceiver::sample_view(const core::Vec3& position, double u1, double u2, double aside) const {
  if (pupil_) return sample_pupil(position, u1, u2, aside);
  std::size_t direction = 0;
  // What u1 leaves over within the share of the direction is a uniform number again.
  for (; direction + 1 < cones_.size() && u1 >= cones_[direction].share; ++direction) u1 -= cones_[direction].share;
  return sample_cone(direction, std::min(u1 / cones_[direction].share, 1.0), u2);
}

View LuminanceReceiver::sample_cone(std::size_t direction, double u1, double u2) const {
  const Cone& cone = cones_[direction];
  const core::Vec3 local = core::sample_cosine_cone(u1, u2, sin_cone_);
  if (!cone.tilted) return {local, 1.0, direction};
  // Drawn with density k.a / (pi sin^2 cone), wanted with k_z over the projected solid angle.
  const core::Vec3 k = local.x() * cone.side + local.y() * cone.up + local.z() * cone.axis;
  return {k, k.z() / (local.z() * cone.axis.z()), direction};
}

std::optional<Score> LuminanceReceiver::score_view(const core::Vec3& seen, const View& view) const {
  const int cell = cells_.index_at(seen.x(), seen.y());
  if (cell < 0) return std::nullopt;
  const std::size_t bin = view.direction * cells_.size() + static_cast<std::size_t>(cell);
  if (!pupil_) return Score{bin, view.weight};
  const core::Vec3 from(seen.x(), seen.y(), pupil_->display_z);
  if (!pupil_->sees(from, view.k)) return std::nullopt;
  return Score{bin, view.weight / pupil_->projected_solid_angle(from)};
}

std::optional<Score> LuminanceReceiver::score(const Crossing& crossing, std::size_t direction) const {
  if (crossing.side != Side::kTop || crossing.estimated) return std::nullopt;
  if (pupil_) return score_view(crossing.position, {crossing.k, 1.0});
  const Cone& cone = cones_[direction];
  if (!sees(crossing.k, cone)) return std::nullopt;
  return score_view(crossing.position, {crossing.k, cone.weight, direction});
}

double luminance_per_score(const LuminanceReceiver& receiver, double flux, std::uint64_t photons) {
  return flux / static_cast<double>(photons) / receiver.cells().cell_area() * core::kCandelaPerM2;
}

LuminanceMap make_luminance_map(const LuminanceReceiver& receiver, const core::Tally& tally, double flux,
                                std::uint64_t photons) {
  const double factor = luminance_per_score(receiver, flux, photons);
  LuminanceMap map{{receiver.cells(), 0.0}, {receiver.cells(), 0.0}};
  for (std::size_t bin = 0; bin < tally.bins(); ++bin) {
    const core::Estimate total = tally.total(bin);
    map.luminance.values[bin] = factor * total.value;
    map.standard_error.values[bin] = factor * total.se;
  }
  return map;
}

}  // namespace evenglow::tracer

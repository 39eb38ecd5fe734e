#include "tracer/goniometer/goniometer_optics.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {
namespace {

/// At normal incidence a film could not tell psi; this much off it can, and nothing else changes.
constexpr double kLeastSigma = 1e-6;  // rad

}  // namespace

GoniometerView::GoniometerView(const GoniometerSpec& spec, double psi)
    : spec_(spec),
      sin_sigma_(std::sin(std::max(spec.sigma, kLeastSigma))),
      cos_sigma_(std::cos(std::max(spec.sigma, kLeastSigma))) {
  const double azimuth = spec.film.axis - psi;  // so that psi counts from the plane of incidence to the film's axis
  h_ = {std::cos(azimuth), std::sin(azimuth), 0.0};
  y_ = {-std::sin(azimuth), std::cos(azimuth), 0.0};
  k_ = (h_ * sin_sigma_ - core::Vec3::UnitZ() * cos_sigma_).normalized();
}

core::StokesVector GoniometerView::partly_linear(double degree, double angle) const {
  const Eigen::Vector4d s(1.0, degree * std::cos(2.0 * angle), degree * std::sin(2.0 * angle), 0.0);
  return from_film(s, tangential_frame(k_));
}

core::StokesVector GoniometerView::linear(double angle) const {
  return partly_linear(1.0, angle);
}

core::StokesVector GoniometerView::light(ScatterKind kind, bool filtered, double filter) const {
  if (!filtered) return partly_linear(0.0, 0.0);
  const double sum = spec_.filter.k1 + spec_.filter.k2;
  const double degree = sum > 0.0 ? (spec_.filter.k1 - spec_.filter.k2) / sum : 0.0;
  const double offset = kind == ScatterKind::reflection ? spec_.offset_reflection : spec_.offset_transmission;
  return partly_linear(degree, filter - offset);
}

core::Vec3 GoniometerView::direction(ScatterKind kind, double phi, double theta) const {
  const double side = kind == ScatterKind::reflection ? 1.0 : -1.0;
  const core::Vec3 axis = h_ * sin_sigma_ + core::Vec3::UnitZ() * (side * cos_sigma_);
  const core::Vec3 u = h_ * cos_sigma_ - core::Vec3::UnitZ() * (side * sin_sigma_);
  return (axis * std::cos(theta) + (u * std::cos(phi) + y_ * std::sin(phi)) * std::sin(theta)).normalized();
}

std::vector<ConePoint> cone_points(double theta, double acceptance) {
  constexpr int kRings = 8, kSectors = 24;
  std::vector<ConePoint> points;
  for (int i = 0; i < kRings; ++i) {
    const double c = 1.0 - (i + 0.5) / kRings * (1.0 - std::cos(acceptance)), s = std::sqrt(1.0 - c * c);
    for (int j = 0; j < kSectors; ++j) {
      const double a = 2.0 * core::kPi * (j + 0.5) / kSectors;
      // About the axis (sin theta, 0, cos theta), with (cos theta, 0, -sin theta) and y beside it.
      const double x = c * std::sin(theta) + s * std::cos(a) * std::cos(theta), y = s * std::sin(a);
      const double z = c * std::cos(theta) - s * std::cos(a) * std::sin(theta);
      points.push_back({std::atan2(y, x), std::atan2(std::hypot(x, y), z)});
    }
  }
  return points;
}

}  // namespace evenglow::tracer

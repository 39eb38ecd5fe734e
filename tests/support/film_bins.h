#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/units.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tests {

/// Bins of the outgoing directions of one incidence: side (0 below, 1 above), then polar cells about the specular axis
/// in direction cosines, u^2 = way over way to the horizon, the azimuth counted from the plane of incidence (where
/// tabulated films have their grid lines, so that the quadrature meets no kinks). Integrals of a BSDF come from
/// `evaluate` alone.
class FilmBins {
 public:
  static constexpr std::size_t kU = 16;
  static constexpr std::size_t kPhi = 10;
  static constexpr std::size_t kSide = kU * kPhi;
  static constexpr std::size_t kCount = 2 * kSide;

  explicit FilmBins(const core::Vec3& k_in) : bx_(k_in.x()), by_(k_in.y()), plane_(std::atan2(by_, bx_)) {}

  std::size_t index(const core::Vec3& k) const {
    const double dx = k.x() - bx_, dy = k.y() - by_;
    const double azimuth = std::atan2(dy, dx);
    const double phi = azimuth - plane_ - 2.0 * core::kPi * std::floor((azimuth - plane_) / (2.0 * core::kPi));
    const double u = std::sqrt(std::hypot(dx, dy) / horizon(azimuth));
    const auto iu = std::min(static_cast<std::size_t>(u * kU), kU - 1);
    const auto iphi = std::min(static_cast<std::size_t>(phi / (2.0 * core::kPi) * kPhi), kPhi - 1);
    return (k.z() > 0.0 ? kSide : 0) + iphi * kU + iu;
  }

  /// Integral of `evaluate` x |cos| over each bin, all four Stokes components in the film's count.
  std::vector<Eigen::Vector4d> integrals(const tracer::Bsdf& film, const core::StokesVector& light) const {
    // Panels of a 4-point Gauss-Legendre rule in u and in phi'.
    static constexpr std::array<double, 4> at{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                              0.9305681557970263};
    static constexpr std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                                  0.1739274225687269};
    constexpr int kPanelsU = 2, kPanels = 4;
    std::vector<Eigen::Vector4d> sums(kCount, Eigen::Vector4d::Zero());
    for (std::size_t iphi = 0; iphi < kPhi * kPanels; ++iphi) {
      for (std::size_t a = 0; a < 4; ++a) {
        const double phi = 2.0 * core::kPi * (static_cast<double>(iphi) + at[a]) / (kPhi * kPanels) + plane_;
        const double r = horizon(phi);
        for (std::size_t iu = 0; iu < kU * kPanelsU; ++iu) {
          for (std::size_t b = 0; b < 4; ++b) {
            const double u = (static_cast<double>(iu) + at[b]) / (kU * kPanelsU);
            const double x = bx_ + u * u * r * std::cos(phi), y = by_ + u * u * r * std::sin(phi);
            const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
            const double area =
                weight[a] * weight[b] * 2.0 * core::kPi / (kPhi * kPanels) / (kU * kPanelsU) * 2.0 * u * u * u * r * r;
            for (const double side : {-1.0, 1.0}) {
              const core::Vec3 k = core::Vec3(x, y, side * z).normalized();
              const std::size_t bin = (side > 0.0 ? kSide : 0) + iphi / kPanels * kU + iu / kPanelsU;
              sums[bin] += area * tracer::to_film(film.evaluate(light, k), tracer::tangential_frame(k));
            }
          }
        }
      }
    }
    return sums;
  }

 private:
  double horizon(double phi) const {
    const double forward = bx_ * std::cos(phi) + by_ * std::sin(phi);
    const double room = 1.0 - bx_ * bx_ - by_ * by_;
    const double root = std::sqrt(forward * forward + room);
    return forward > 0.0 ? room / (root + forward) : root - forward;
  }
  double bx_, by_;
  double plane_;  ///< azimuth of the plane of incidence
};

/// Light for film tests: natural, linear at three angles, right circular.
inline std::vector<core::StokesVector> test_lights(const core::Vec3& k) {
  const core::PolarizationFrame frame = tracer::tangential_frame(k).frame;
  return {core::StokesVector::unpolarized(1.0, frame), core::StokesVector::linear(1.0, 0.0, frame),
          core::StokesVector::linear(1.0, 1.0, frame), core::StokesVector::linear(1.0, -0.6, frame),
          core::StokesVector{1.0, 0.0, 0.0, 1.0, frame}};
}

/// Direction of travel at `sigma_deg` from the normal with tangential azimuth `azimuth_deg`; `up`: from below.
inline core::Vec3 travel(double sigma_deg, double azimuth_deg, bool up = false) {
  const double s = sigma_deg * core::kRadPerDeg, a = azimuth_deg * core::kRadPerDeg;
  return {std::sin(s) * std::cos(a), std::sin(s) * std::sin(a), up ? std::cos(s) : -std::cos(s)};
}

}  // namespace evenglow::tests

#pragma once

#include "core/light/stokes.h"
#include "tracer/goniometer/goniometer_spec.h"

/// Directions and light of a goniometer in the film's frame. Light comes from above; the film lies still and the plane
/// of incidence is turned by -psi instead.
namespace evenglow::tracer {

/// The film turned by psi: everything in the frame in which its own axis is where its key says.
class GoniometerView {
 public:
  GoniometerView(const GoniometerSpec& spec, double psi);

  /// Light of unit power behind the filter (`filtered`) or natural light.
  core::StokesVector light(ScatterKind kind, bool filtered, double filter) const;
  /// Fully linear light of unit power at `angle` from e1.
  core::StokesVector linear(double angle) const;
  /// Direction at (phi, theta) from the specular or the direct axis.
  core::Vec3 direction(ScatterKind kind, double phi, double theta) const;

 private:
  core::StokesVector partly_linear(double degree, double angle) const;

  const GoniometerSpec& spec_;
  core::Vec3 k_;  ///< of the incident light
  core::Vec3 h_, y_;
  double sin_sigma_, cos_sigma_;
};

/// A point of the cone of half-angle `acceptance` about (phi = 0, theta), in angles from the axis, with its share of
/// the cone's solid angle.
struct ConePoint {
  double phi = 0.0, theta = 0.0;
};
/// Midpoints of rings and sectors of equal solid angle.
std::vector<ConePoint> cone_points(double theta, double acceptance);

}  // namespace evenglow::tracer

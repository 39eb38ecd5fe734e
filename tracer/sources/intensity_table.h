#pragma once

#include <cstddef>
#include <vector>

namespace evenglow::tracer {

/// How the azimuths of a table stand for the whole circle.
enum class AzimuthSymmetry {
  kNone,           ///< 0 to 360 degrees, the last equal to the first or not
  kRotation,       ///< one azimuth stands for all
  kPlane0To180,    ///< 0 to 180: the half beyond the plane 0-180 is a mirror image
  kPlane90To270,   ///< 90 to 270: the half beyond the plane 90-270 is a mirror image
  kQuadrant0To90,  ///< 0 to 90: mirror images beyond both planes
};

/// The symmetry that the range of azimuths of type C photometry tells: 0 alone, 0 to 90, 180 or 360, or 90 to 270
/// degrees; throws `core::Error` for any other range.
AzimuthSymmetry symmetry_of_range(double first_deg, double last_deg);

/// Luminous intensity on a grid of polar angle theta and azimuth phi, bilinear in both between the nodes and zero
/// beyond the first and last theta. The azimuths run once around.
struct IntensityTable {
  std::vector<double> theta;   ///< rad, rising within [0, pi], two at least
  std::vector<double> phi;     ///< rad, rising from 0 to 2 pi, two at least
  std::vector<double> values;  ///< cd (or relative), >= 0, index iphi * theta.size() + itheta

  double at(std::size_t iphi, std::size_t itheta) const { return values[iphi * theta.size() + itheta]; }
  /// The intensity at a direction; phi in [0, 2 pi].
  double intensity(double theta_at, double phi_at) const;
};

/// The whole circle out of the azimuths that a file gives: `phi` (rad) rises over the range that its symmetry tells,
/// `values` (cd) has the index iphi * theta.size() + itheta.
IntensityTable whole_circle(std::vector<double> theta, const std::vector<double>& phi,
                            const std::vector<double>& values, AzimuthSymmetry symmetry);

/// The part of the table with theta <= 90 degrees (with a node there, interpolated, if the table goes on beyond); no
/// theta at all if it begins there.
IntensityTable front_hemisphere(const IntensityTable& table);

/// Flux of the cell between the nodes i, i + 1 of phi and j, j + 1 of theta: the integral of
/// I(theta, phi) sin(theta) d(theta) d(phi), in closed form. Unit of the table x sr.
double cell_flux(const IntensityTable& table, std::size_t i, std::size_t j);
/// Sum over all cells.
double total_flux(const IntensityTable& table);

}  // namespace evenglow::tracer

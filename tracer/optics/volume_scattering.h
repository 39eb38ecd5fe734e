#pragma once

#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {

/// Scattering by small particles in the bulk of a sheet.
struct VolumeScattering {
  double coefficient = 0.0;     ///< 1/mm: one scatter on average in 1 / coefficient
  double anisotropy = 0.9;      ///< g, mean cosine of the scattering angle, in (-1, 1)
  double depolarization = 1.0;  ///< share of the polarization that a scatter takes, [0, 1]

  /// Way to the next scatter, mm.
  double free_path(core::PhotonRng& rng) const;

  /// Light after a scatter: direction by Henyey & Greenstein (Astrophys. J. 93, 1941), azimuth even; what polarization
  /// is left keeps to the field, carried along the great circle from the old to the new direction. A model for many
  /// weak forward scatters, whose polarization turns with the ray; it does not polarize natural light.
  core::StokesVector scatter(const core::StokesVector& light, core::PhotonRng& rng) const;
};

/// Cosine of a Henyey-Greenstein scattering angle for a uniform number in (0, 1).
double henyey_greenstein_cosine(double anisotropy, double uniform);

}  // namespace evenglow::tracer

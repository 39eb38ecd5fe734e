#pragma once

#include <cstddef>
#include <vector>

#include "core/math/vec3.h"
#include "tracer/sources/spectrum.h"

namespace evenglow::tracer {

/// The wavelengths that photons are traced at. The lines of all sources are gathered into bands of nearly equal odds;
/// what is not light itself (indices, absorption, films) is taken at the mean wavelength of a band, while the colors
/// that a band stands for are summed line by line, so that the color and the flux of a source are exact.
///
/// A photon gets its band with the odds of the band's luminance Y if only luminance is asked for: then every photon
/// carries the same luminous flux, and luminance, efficiency and energy account cost not one photon more than with one
/// wavelength. Where color is asked for, the odds are half those of Y and half those of X + Y + Z: blue light, which
/// decides on z but has hardly any luminance, would else be left to a few heavy photons.
class SpectralBands {
 public:
  /// `spectra` and `fluxes` (lm) of the sources; at most `count` bands, and a band of its own for each line of a
  /// spectrum that has less. Without sources: one band of 550 nm.
  SpectralBands(const std::vector<Spectrum>& spectra, const std::vector<double>& fluxes, std::size_t count, bool color);

  std::size_t size() const { return wavelengths_.size(); }
  double wavelength(std::size_t band) const { return wavelengths_[band]; }  ///< nm

  struct Choice {
    std::size_t band = 0;
    core::Vec3 weight = core::Vec3::Ones();  ///< X, Y, Z that the photon carries, in units of the mean Y of all photons
  };
  /// Band of a photon of this source, for a uniform number in (0, 1).
  Choice choose(std::size_t source, double uniform) const;

  /// Mean weight of the photons of all sources: tristimulus values of the light as it is emitted, Y = 1.
  core::Vec3 mean_weight() const { return mean_; }

 private:
  struct Share {
    double up_to = 0.0;  ///< cumulative odds
    std::size_t band = 0;
    core::Vec3 weight;
  };
  std::vector<double> wavelengths_;
  std::vector<std::vector<Share>> sources_;
  core::Vec3 mean_ = core::Vec3::Ones();
};

}  // namespace evenglow::tracer

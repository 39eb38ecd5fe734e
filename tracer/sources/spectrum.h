#pragma once

#include <vector>

#include "core/config/config_node.h"
#include "core/math/vec3.h"

namespace evenglow::tracer {

/// Spectral power of a source as lines: relative radiant power at ascending wavelengths (nm) between 380 and 780 nm. A
/// continuous spectrum has one line a nanometer.
struct Spectrum {
  std::vector<double> wavelength;
  std::vector<double> power;

  /// Tristimulus values; Y > 0 for every spectrum that `read_spectrum` makes.
  core::Vec3 xyz() const;
};

Spectrum monochromatic(double wavelength);

/// A peak of an LED: (g + 2 g^5) / 3 with g = exp(-((l - center) / width)^2), scaled to full width `fwhm` at half its
/// height (Ohno, "Spectral design considerations for white LED color rendering", Opt. Eng. 44, 111302, 2005).
double led_peak(double wavelength, double center, double fwhm);

/// Reads the key `spectrum` of a source; without it light of 550 nm, as of a run that knows no color.
///
/// | kind | key | meaning | default |
/// | --- | --- | --- | --- |
/// | monochromatic | wavelength_nm | 380 to 780 | 550 |
/// | table | file | CSV: `wavelength_nm,power`, relative power per nm, two rows at least, linear between the rows, 0
/// outside; taken together nanometer by nanometer | |
/// | white_led | blue_nm, blue_fwhm_nm | peak of the chip | 450, 20 |
/// |  | phosphor_nm, phosphor_fwhm_nm | peak and full width of its power per nm, a Gaussian on a scale of
/// wavenumbers: steeper on the blue side | 560, 120 |
/// |  | blue_share | of the radiant power | 0.3 |
/// | rgb | peaks_nm, fwhm_nm, powers | three peaks: centers, widths, radiant powers | [630, 525, 455], [20, 32, 22],
/// [1, 1, 1] | | equal_energy |  | the same power at every wavelength | |
Spectrum read_spectrum(const core::ConfigNode& source);

}  // namespace evenglow::tracer

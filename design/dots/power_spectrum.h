#pragma once

#include <vector>

#include "design/dots/sample_windows.h"

namespace evenglow::design {

/// Power spectrum of the places of the dots, |sum exp(-2 pi i f r)|^2 / N, averaged over windows of nearly even
/// density, at frequencies in units of the root of the local density of dots (1 over the mean spacing). 1 for dots by
/// chance; blue noise: near 0 below the principal frequency of about 1 (Ulichney, Digital Halftoning, 1987; Lagae &
/// Dutre, Comput. Graph. Forum 27, 2008). What the linear part of the density adds at low frequencies is taken off.
struct PowerSpectrum {
  static constexpr double kBin = 0.05;  ///< width of a bin of the radial mean
  static constexpr int kBins = 60;
  static constexpr int kHalf = 60;  ///< the map has 2 kHalf + 1 points a side, from -3 to 3

  std::size_t windows = 0;
  std::vector<double> radial;  ///< mean power in [kBin i, kBin (i + 1)); NaN: no frequency of the windows in it
  std::vector<double> map;     ///< power at (fx, fy), row fy from the lowest
  double low_power = 0.0;      ///< mean power from 0.1 to 0.5
  double peak_power = 0.0;     ///< of the radial mean
  double peak_frequency = 0.0;
  /// Greatest mean power in one of 36 directions over the mean of all, from 0.8 to 1.4: near 1 if the pattern has no
  /// direction, many times that for a lattice.
  double direction_contrast = 0.0;
};

PowerSpectrum power_spectrum(const std::vector<SampleWindow>& windows, int threads);

}  // namespace evenglow::design

#pragma once

#include <span>
#include <string_view>

namespace evenglow::tracer {

/// Parameters of the semi-empirical model of a scattering reflective polarizer (`LobeModel`), with the values that were
/// fitted to the published luminance tables of a DBEF sample (configs/data/README.md). Widths are in direction cosines.
/// Amplitudes are luminances (cd/m2) of a film that is lit by `e0` with light polarized along one axis.
struct LobeParameters {
  double sx = 0.07466, sy = 0.10178;                ///< narrow reflected lobe, along the pass and the block axis
  double s2 = 0.17775;                              ///< middle reflected lobe
  double s3p = 0.33035, s3b = 0.57813;              ///< wide reflected lobe of pass and of block light
  double p1 = 286.76, p3 = 39.134;                  ///< reflected pass light: narrow, wide
  double b1 = 5686.5, b2 = 463.48, b3 = 10.952;     ///< reflected block light: narrow, middle, wide
  double t1 = 0.09702, t2 = 0.13653, t3 = 0.52847;  ///< transmitted lobes
  double a1 = 3995.96, a2 = 1005.15, a3 = 5.9505;   ///< transmitted pass light
  double a2b = 158.28, a3b = 2.1370;                ///< transmitted block light
  double e0 = 409.15;                               ///< illuminance that the amplitudes belong to, lx
  double absorption = 0.015;                        ///< of light of either polarization
  double refractive_index = 1.58;                   ///< rules the share of T at oblique incidence
};

/// One parameter: its key in files and what it may be.
struct LobeParameter {
  std::string_view key;
  std::string_view help;
  double LobeParameters::*member;
  double least, greatest;
};

/// All of them, in the order of the struct.
std::span<const LobeParameter> lobe_parameters();

}  // namespace evenglow::tracer

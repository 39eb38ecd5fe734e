#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/montecarlo/estimate.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// Polarization of the light that falls on the film. `pass` is linear along the film's axis as the ray sees it
/// (pass_axis.h with `Film::axis_index`), `block` across it, `diagonal` at 45 degrees from it, counted towards z x h
/// (docs/conventions.md); `right` and `left` are circular.
enum class SweepLight { natural, pass, block, diagonal, right, left };

/// What a film is measured at: every combination.
struct SweepSpec {
  std::vector<double> wavelengths{550.0};  ///< nm
  std::vector<double> azimuths{0.0};       ///< rad, of the ray's tangential direction, from +x towards +y
  std::vector<double> sigmas;              ///< rad, angle of incidence, [0, pi / 2)
  std::vector<SweepLight> lights{SweepLight::natural};
  bool from_above = false;          ///< else from the plate's side
  std::uint64_t photons = 100'000;  ///< of each row of a film that scatters or redirects, > 0
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all
  std::stop_token stop{};
  std::function<void(std::uint64_t)> progress{};  ///< photons done so far; from any thread, one call at a time
};

/// Shares of the incident power. Exact (se 0) for films that are told by `Bsdf::specular`, clear sheets with a body
/// included; counted photons with binomial standard errors for the others, where the shares sum to 1 exactly. A sheet
/// that scatters in its bulk is traced through its faces (scattering_sheet.h).
struct SweepRow {
  double wavelength = 550.0, azimuth = 0.0, sigma = 0.0;
  SweepLight light = SweepLight::natural;
  core::Estimate reflectance, transmittance;                      ///< into the hemisphere
  core::Estimate specular_reflectance, specular_transmittance;    ///< in the mirrored and in the straight direction
  core::Estimate scattered_reflectance, scattered_transmittance;  ///< elsewhere: scattered or redirected
  core::Estimate absorbed;
  /// Straight light, if there is any and the film tells it: degree of polarization, and Q, U, V over I in the ray's
  /// right-handed frame with e1 in the plane of incidence (tangential part along the ray's).
  struct State {
    double degree = 0.0, q = 0.0, u = 0.0, v = 0.0;
  };
  std::optional<State> transmitted;
  /// At normal incidence, if anything passes: haze as of ASTM D1003 (haze.h), a share of the transmitted light.
  std::optional<core::Estimate> haze;
  /// Of a prism film: facets of the structured face that a photon meets, from inside and outside, on average.
  std::optional<core::Estimate> facets;
};

/// Rows of the spec: wavelength, azimuth, light, sigma; the last fastest. Empty if it was stopped. The numbers depend
/// on the seed, not on the threads.
std::optional<std::vector<SweepRow>> sweep_film(const Film& film, const SweepSpec& spec);

/// Is the film measured by photons?
bool needs_photons(const Film& film);

}  // namespace evenglow::tracer

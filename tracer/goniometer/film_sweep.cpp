#include "tracer/goniometer/film_sweep.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "core/base/units.h"
#include "core/montecarlo/batches.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/films/bef.h"
#include "tracer/films/haze.h"
#include "tracer/films/scattering_sheet.h"
#include "tracer/optics/dielectric_face.h"
#include "tracer/polarized_bsdf/pass_axis.h"

namespace evenglow::tracer {
namespace {

/// Directions closer than this (the sine of half a thousandth of a degree) are one.
constexpr double kSameDirection = 1e-5;
/// Photons between two looks at the stop token.
constexpr std::uint64_t kPhotonsPerLook = 1 << 16;

/// One film at one wavelength.
struct Optics {
  const Bsdf* surface = nullptr;
  const DielectricSheet* sheet = nullptr;
  std::shared_ptr<const FilmOptics> made;  ///< what the two point to, if it was made for the wavelength
  std::shared_ptr<const Bsdf> scattering;  ///< a scattering sheet as a surface
  bool tells_straight = true;              ///< `specular` holds all straight light
};

Optics optics_at(const Film& film, double wavelength) {
  Optics optics{film.surface.get(), film.sheet ? &*film.sheet : nullptr, {}, {}, true};
  if (film.at_wavelength) {
    optics.made = std::make_shared<const FilmOptics>(film.at_wavelength(wavelength));
    optics.surface = optics.made->surface.get();
    optics.sheet = optics.made->sheet ? &*optics.made->sheet : nullptr;
  }
  if (optics.sheet != nullptr && optics.sheet->scattering) {
    optics.scattering = std::make_shared<const ScatteringSheet>(*optics.sheet);
    optics.surface = optics.scattering.get();
    optics.sheet = nullptr;
  } else if (optics.surface != nullptr) {
    optics.tells_straight = !optics.surface->redirects();
  }
  return optics;
}

bool is_counted(const Bsdf* surface) {
  return surface != nullptr && (surface->scatters() || surface->redirects());
}

core::Vec3 direction_of(const SweepRow& row, bool from_above) {
  const double s = std::sin(row.sigma);
  return core::Vec3(s * std::cos(row.azimuth), s * std::sin(row.azimuth),
                    (from_above ? -1.0 : 1.0) * std::cos(row.sigma))
      .normalized();
}

Eigen::Vector4d light_of(SweepLight light, const Film& film, const TangentialFrame& frame) {
  if (light == SweepLight::natural) return {1, 0, 0, 0};
  if (light == SweepLight::right || light == SweepLight::left) {
    return {1, 0, 0, light == SweepLight::right ? frame.sign : -frame.sign};
  }
  const double cos_psi = std::cos(film.axis) * frame.azimuth_cos + std::sin(film.axis) * frame.azimuth_sin;
  const double sin_psi = std::sin(film.axis) * frame.azimuth_cos - std::cos(film.axis) * frame.azimuth_sin;
  const AxisAngle chi = pass_axis(cos_psi, sin_psi, frame.sin_polar, film.axis_index);
  if (light == SweepLight::pass) return {1, chi.cos2, chi.sin2, 0};
  if (light == SweepLight::block) return {1, -chi.cos2, -chi.sin2, 0};
  return {1, -chi.sin2, chi.cos2, 0};
}

void set_state(const Eigen::Vector4d& s, const TangentialFrame& frame, SweepRow& row) {
  if (s[0] <= 1e-15) return;
  const Eigen::Vector3d p = s.tail<3>() / s[0];
  row.transmitted = {p.norm(), p[0], frame.sign * p[1], frame.sign * p[2]};
}

void set_exact(const Bsdf::Specular& s, const Eigen::Vector4d& light, const TangentialFrame& frame, SweepRow& row) {
  const Eigen::Vector4d through = s.transmission * light;
  row.transmittance.value = row.specular_transmittance.value = through[0];
  row.reflectance.value = row.specular_reflectance.value = (s.reflection * light)[0];
  row.absorbed.value = std::max(0.0, 1.0 - row.transmittance.value - row.reflectance.value);
  if (row.sigma == 0.0 && row.transmittance.value > 0.0) row.haze = core::Estimate{};
  set_state(through, frame, row);
}

core::Estimate binomial(double hits, double trials) {
  const double p = hits / trials;
  return {p, std::sqrt(p * (1.0 - p) / trials)};
}

/// Outcomes of the photons of one row.
struct Counts {
  double through[2] = {0, 0};  ///< specular, elsewhere
  double back[2] = {0, 0};
  double deviated = 0;  ///< of `through`: by more than the angle of haze
  double facets = 0, squared_facets = 0;
};

/// What becomes of a photon; a prism film also tells the facets that it met.
std::optional<BsdfSample> outcome(const Bsdf& surface, const PrismFilm* prisms, const core::StokesVector& light,
                                  core::PhotonRng& rng, Counts& counts) {
  if (prisms == nullptr) return surface.sample(light, rng);
  const PrismPass pass = prisms->trace(light, rng);
  counts.facets += pass.facets;
  counts.squared_facets += static_cast<double>(pass.facets) * pass.facets;
  if (!pass.light) return std::nullopt;
  return BsdfSample{*pass.light, true};
}

/// False if it was stopped.
bool count(const Bsdf& surface, const core::StokesVector& light, const core::RandomKey& key, const SweepSpec& spec,
           Counts& counts) {
  const core::Vec3& k = light.frame.k;
  const core::Vec3 mirrored(k.x(), k.y(), -k.z());
  const double least_cosine = std::cos(kHazeAngle);
  const auto* const prisms = dynamic_cast<const PrismFilm*>(&surface);
  for (std::uint64_t i = 0; i < spec.photons; ++i) {
    if (i % kPhotonsPerLook == 0 && spec.stop.stop_requested()) return false;
    core::PhotonRng rng(key, i);
    const auto out = outcome(surface, prisms, light, rng, counts);
    if (!out) continue;
    const bool through = out->light.frame.k.z() * k.z() > 0.0;
    const bool straight = out->specular && (out->light.frame.k - (through ? k : mirrored)).norm() < kSameDirection;
    ++(through ? counts.through : counts.back)[straight ? 0 : 1];
    if (through && out->light.frame.k.dot(k) < least_cosine) ++counts.deviated;
  }
  return true;
}

void set_counted(const Counts& c, double n, SweepRow& row) {
  row.specular_transmittance = binomial(c.through[0], n);
  row.scattered_transmittance = binomial(c.through[1], n);
  row.specular_reflectance = binomial(c.back[0], n);
  row.scattered_reflectance = binomial(c.back[1], n);
  row.transmittance = binomial(c.through[0] + c.through[1], n);
  row.reflectance = binomial(c.back[0] + c.back[1], n);
  row.absorbed = binomial(n - c.through[0] - c.through[1] - c.back[0] - c.back[1], n);
  if (c.facets > 0.0) {
    const double mean = c.facets / n;
    row.facets = core::Estimate{mean, std::sqrt(std::max(0.0, c.squared_facets / n - mean * mean) / n)};
  }
  const double passed = c.through[0] + c.through[1];
  if (row.sigma == 0.0 && passed > 0.0) row.haze = binomial(c.deviated, passed);
}

/// False if it was stopped.
bool measure_row(const Film& film, const Optics& optics, const SweepSpec& spec, std::size_t index, SweepRow& row) {
  const core::Vec3 k = direction_of(row, spec.from_above);
  const TangentialFrame frame = tangential_frame(k);
  const Eigen::Vector4d light = light_of(row.light, film, frame);
  if (optics.sheet != nullptr) {
    const DielectricSheet& s = *optics.sheet;
    set_exact(incoherent_sheet(std::abs(k.z()), s.refractive_index, s.absorption, s.thickness), light, frame, row);
    return true;
  }
  if (!is_counted(optics.surface)) {
    set_exact(optics.surface->specular(k), light, frame, row);
    return true;
  }
  Counts counts;
  const core::RandomKey key{spec.seed, static_cast<std::uint32_t>(index), 0};
  if (!count(*optics.surface, from_film(light, frame), key, spec, counts)) return false;
  set_counted(counts, static_cast<double>(spec.photons), row);
  if (optics.tells_straight) set_state(optics.surface->specular(k).transmission * light, frame, row);
  return true;
}

std::vector<SweepRow> rows_of(const SweepSpec& spec) {
  std::vector<SweepRow> rows;
  for (const double wavelength : spec.wavelengths) {
    for (const double azimuth : spec.azimuths) {
      for (const SweepLight light : spec.lights) {
        for (const double sigma : spec.sigmas) {
          SweepRow row;
          row.wavelength = wavelength;
          row.azimuth = azimuth;
          row.sigma = sigma;
          row.light = light;
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

}  // namespace

bool needs_photons(const Film& film) {
  return is_counted(film.surface.get()) || (film.sheet && film.sheet->scattering);
}

std::optional<std::vector<SweepRow>> sweep_film(const Film& film, const SweepSpec& spec) {
  std::vector<SweepRow> rows = rows_of(spec);
  const std::size_t per_wavelength = spec.azimuths.size() * spec.lights.size() * spec.sigmas.size();
  std::mutex mutex;
  std::uint64_t done = 0;
  // Wavelength by wavelength: a tabulated film is too large to keep one for each.
  for (std::size_t first = 0; first < rows.size(); first += per_wavelength) {
    const Optics optics = optics_at(film, rows[first].wavelength);
    const auto measure = [&](std::size_t i) {
      if (!measure_row(film, optics, spec, first + i, rows[first + i])) return;
      if (!spec.progress || !is_counted(optics.surface)) return;
      const std::lock_guard lock(mutex);
      done += spec.photons;
      spec.progress(done);
    };
    if (!core::run_batches(per_wavelength, spec.threads, measure, spec.stop) || spec.stop.stop_requested()) {
      return std::nullopt;
    }
  }
  return rows;
}

}  // namespace evenglow::tracer

#include "tracer/transport/next_event.h"

#include <cmath>

#include <Eigen/LU>

#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {
namespace {

using core::MuellerMatrix;
using core::Vec3;

/// Transmission upwards and reflection of light from above (k mirrored) and from below.
struct Layer {
  MuellerMatrix up;
  MuellerMatrix reflect_below;
  MuellerMatrix reflect_above;
  MuellerMatrix down;
};

Layer layer_of(const ViewedFilm& film, const Vec3& k) {
  if (film.sheet) {
    const Bsdf::Specular s =
        incoherent_sheet(k.z(), film.sheet->refractive_index, film.sheet->absorption, film.sheet->thickness);
    return {s.transmission, s.reflection, s.reflection, s.transmission};
  }
  const Bsdf::Specular up = film.surface->specular(k);
  const Bsdf::Specular down = film.surface->specular({k.x(), k.y(), -k.z()});
  return {up.transmission, up.reflection, down.reflection, down.transmission};
}

}  // namespace

NextEvent::NextEvent(const Scene& scene) : scene_(scene) {}

MuellerMatrix NextEvent::transmission(const Vec3& k, std::size_t band) const {
  const std::vector<ViewedFilm>& films = scene_.optics[band].viewed_films;
  // Adding method: the lower stack (T upwards, R for light from above) below one more film.
  MuellerMatrix T = MuellerMatrix::Identity();
  MuellerMatrix R = MuellerMatrix::Zero();
  for (std::size_t i = 0; i < films.size(); ++i) {
    const Layer film = layer_of(films[i], k);
    if (i == 0) {
      T = film.up;
      R = film.reflect_above;
      continue;
    }
    const MuellerMatrix many = (MuellerMatrix::Identity() - R * film.reflect_below).inverse();
    T = film.up * many * T;
    R = film.reflect_above + film.up * many * R * film.down;
  }
  return T;
}

Vec3 NextEvent::display_position(const Vec3& position, const Vec3& k, std::size_t band) const {
  double height = scene_.box.max.z() - position.z();
  Vec3 shift = Vec3::Zero();
  const double sin2 = 1.0 - k.z() * k.z();
  for (const ViewedFilm& film : scene_.optics[band].viewed_films) {
    if (!film.sheet) continue;
    const double n = film.sheet->refractive_index;
    height -= film.sheet->thickness;
    shift += film.sheet->thickness / std::sqrt(n * n - sin2) * Vec3(k.x(), k.y(), 0.0);
  }
  return position + height / k.z() * k + shift;
}

bool NextEvent::in_front(const Vec3& seen) const {
  const Box& box = scene_.box;
  return seen.x() >= box.min.x() && seen.x() <= box.max.x() && seen.y() >= box.min.y() && seen.y() <= box.max.y();
}

bool NextEvent::sees(const Vec3& position, const Vec3& k, std::size_t band) const {
  return k.z() > 0.0 && in_front(display_position(position, k, band));
}

std::optional<Score> NextEvent::score(const Bsdf& surface, const core::StokesVector& light, const Vec3& position,
                                      std::size_t band, core::PhotonRng& rng) const {
  const double u1 = rng.uniform();
  const auto [k, weight] = scene_.luminance.sample_view(u1, rng.uniform());
  const Vec3 seen = display_position(position, k, band);
  if (!in_front(seen)) return {};
  const int bin = scene_.luminance.cells().index_at(seen.x(), seen.y());
  if (bin < 0) return {};
  const core::StokesVector scattered = surface.evaluate(light, k);
  if (scattered.I <= 0.0) return {};
  double power = scattered.I;
  if (!scene_.optics[band].viewed_films.empty()) {
    const Eigen::Vector4d s = to_film(scattered, tangential_frame(k));
    power = transmission(k, band).row(0).dot(s);
  }
  return Score{static_cast<std::size_t>(bin), power * weight};
}

}  // namespace evenglow::tracer

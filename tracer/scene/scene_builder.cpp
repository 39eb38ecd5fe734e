#include "tracer/scene/scene_builder.h"

#include <algorithm>
#include <cmath>

#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

/// Unit vector in a face that lies along `direction` as far as it can.
Vec3 along_face(const Vec3& direction, const Vec3& normal) {
  return (direction - direction.dot(normal) * normal).normalized();
}

/// Side of a plate whose bottom rises by `lift` (mm) from x = min to max. Front and back keep the rectangle; what the
/// rising bottom cuts off them is for `Surface::trim_normal`.
Quad side_of_wedge(const Box& box, Side side, double lift) {
  Quad quad = side_of(box, side);
  if (side == Side::kBottom) {
    for (Vec3* edge : {&quad.u, &quad.v}) {
      if (edge->x() > 0.0) edge->z() += lift;
    }
  }
  if (side == Side::kRight) {
    for (Vec3* edge : {&quad.u, &quad.v}) {
      if (edge->z() > 0.0) edge->z() -= lift;
    }
    quad.corner.z() += lift;
  }
  return quad;
}

}  // namespace

SceneBuilder::SceneBuilder(const BacklightSpec& spec, double wavelength) : spec_(spec), wavelength_(wavelength) {
  box_ = interior();
  if (spec_.plate) add_plate();
  for (int i = 0; i < kSides; ++i) add_reflector(static_cast<Side>(i));
  add_films();
  for (std::size_t i = 0; i < spec_.sources.size(); ++i) add_source(i);
}

int SceneBuilder::part(std::string name) {
  parts_.push_back(std::move(name));
  return static_cast<int>(parts_.size()) - 1;
}

int SceneBuilder::add(const Quad& quad, Surface surface) {
  surface.normal = quad.normal();
  // The local x of horizontal surfaces is the plate's x: a film's axis counts from it.
  surface.x = std::abs(surface.normal.z()) > 0.5 ? along_face(Vec3::UnitX(), surface.normal) : quad.u.normalized();
  surface.y = surface.normal.cross(surface.x);
  quads_.push_back(quad);
  optics_.surfaces.push_back(std::move(surface));
  return static_cast<int>(quads_.size()) - 1;
}

Box SceneBuilder::interior() const {
  Box box = spec_.area;
  for (const Film& film : spec_.films) box.max.z() += film.gap + (film.sheet ? film.sheet->thickness : 0.0);
  for (int i = 0; i < kSides; ++i) {
    const auto side = static_cast<Side>(i);
    const auto& reflector = spec_.reflectors[static_cast<std::size_t>(i)];
    if (reflector)
      (is_upper(side) ? box.max : box.min)[axis_of(side)] += is_upper(side) ? reflector->gap : -reflector->gap;
  }
  return box;
}

void SceneBuilder::add_body(const Box& place, const Body& body, double lift) {
  const int id = static_cast<int>(optics_.bodies.size());
  optics_.bodies.push_back(body);
  optics_.owned.push_back(std::make_unique<DielectricFace>(body.refractive_index, 1.0));
  for (int i = 0; i < kSides; ++i) {
    Surface surface;
    surface.optics = optics_.owned.back().get();
    surface.part = body.part;
    surface.body = id;
    const auto side = static_cast<Side>(i);
    if (lift > 0.0 && (side == Side::kFront || side == Side::kBack)) {
      surface.trim_normal = Vec3(-lift, 0.0, place.max.x() - place.min.x()).normalized();
      surface.trim_offset = surface.trim_normal.dot(place.min);
    }
    add(side_of_wedge(place, side, lift), std::move(surface));
  }
}

void SceneBuilder::add_plate() {
  const Material material = spec_.plate->material(wavelength_);
  add_body(spec_.area, {material.refractive_index, material.absorption, part("light_guide_plate")},
           spec_.plate->thickness - spec_.plate->end_thickness);
  if (spec_.plate->entrance) serrate(*spec_.plate->entrance, material.refractive_index);
  if (!spec_.microstructure) return;
  Surface& face = optics_.surfaces[static_cast<std::size_t>(spec_.microstructure->face)];
  optics_.owned.push_back(spec_.microstructure->shape.optics(material.refractive_index));
  face.pattern = optics_.owned.back().get();
  face.pattern_part = part("microstructure");
}

void SceneBuilder::serrate(const EntranceTexture& texture, double index) {
  for (const Side side : texture.sides) {
    Surface& face = optics_.surfaces[static_cast<std::size_t>(side)];
    optics_.owned.push_back(texture.optics(index, std::atan2(face.y.z(), face.x.z())));  // ridges along z
    face.optics = optics_.owned.back().get();
  }
}

void SceneBuilder::add_reflector(Side side) {
  const auto& reflector = spec_.reflectors[static_cast<std::size_t>(side)];
  if (!reflector) return;
  Surface surface;
  surface.optics = reflector->surface.get();
  surface.part = part(std::string("reflectors.") + side_name(side));
  // Beside a backlight of no height (neither plate nor film) a sheet has no area to be met.
  if (axis_of(side) != 2 && box_.max.z() <= box_.min.z()) return;
  reflector_quads_[static_cast<std::size_t>(side)] = add(side_of(box_, side), std::move(surface));
}

std::pair<const Bsdf*, std::optional<DielectricSheet>> SceneBuilder::optics_of(const Film& film) {
  if (!film.at_wavelength) return {film.surface.get(), film.sheet};
  FilmOptics made = film.at_wavelength(wavelength_);
  const Bsdf* thin = made.surface.get();
  if (made.surface) optics_.owned.push_back(std::move(made.surface));
  return {thin, made.sheet};
}

void SceneBuilder::add_films() {
  double z = spec_.area.max.z();
  for (std::size_t i = 0; i < spec_.films.size(); ++i) {
    const Film& film = spec_.films[i];
    const int film_part = part("films[" + std::to_string(i) + "]:" + film.kind);
    z += film.gap;
    Box place = box_;
    place.min.z() = place.max.z() = z;
    const auto [thin, sheet] = optics_of(film);
    if (sheet) {
      place.max.z() = z += sheet->thickness;
      add_body(place, {sheet->refractive_index, sheet->absorption, film_part, sheet->scattering});
    } else {
      Surface surface;
      surface.optics = thin;
      surface.part = film_part;
      add(side_of(place, Side::kTop), std::move(surface));
    }
  }
}

void SceneBuilder::add_source(std::size_t index) {
  const Source& source = *spec_.sources[index];
  const Side side = source.side();
  const auto windows = source.windows();
  if (windows.empty()) {
    source_placements_.push_back({});
    return;
  }
  const int source_part = part("sources[" + std::to_string(index) + "]:" + spec_.source_kinds[index]);
  const int along = axis_of(side) == 0 ? 1 : 0;
  const auto& reflector = spec_.reflectors[static_cast<std::size_t>(side)];
  if (reflector && reflector->gap == source.gap()) {
    const int quad = reflector_quads_[static_cast<std::size_t>(side)];
    Surface& surface = optics_.surfaces[static_cast<std::size_t>(quad)];
    for (const SourceWindow& window : windows) {
      Vec3 a = Vec3::Zero();
      Vec3 b = Vec3::Zero();
      a[along] = window.min_along;
      a.z() = window.min_z;
      b[along] = window.max_along;
      b.z() = window.max_z;
      const auto [x0, x1] = std::minmax({surface.x.dot(a), surface.x.dot(b)});
      const auto [y0, y1] = std::minmax({surface.y.dot(a), surface.y.dot(b)});
      surface.windows.push_back({x0, x1, y0, y1, source.window_surface(), source_part});
    }
    source_placements_.push_back({quad, false});
    return;
  }
  Box place = spec_.area;
  const double plane = spec_.area.plane(side) + (is_upper(side) ? source.gap() : -source.gap());
  place.min[axis_of(side)] = place.max[axis_of(side)] = plane;
  source_placements_.push_back({static_cast<int>(quads_.size()), true});
  for (const SourceWindow& window : windows) {
    place.min[along] = window.min_along;
    place.max[along] = window.max_along;
    place.min.z() = window.min_z;
    place.max.z() = window.max_z;
    Surface surface;
    surface.optics = source.window_surface();
    surface.part = source_part;
    add(side_of(place, side), std::move(surface));
  }
}

}  // namespace evenglow::tracer

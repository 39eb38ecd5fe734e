#include "app/section_paths.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tracer/transport/photon_path.h"

namespace evenglow::app {
namespace {

using design::LayerKind;
using design::PolarizationLook;
using design::SectionLayer;

/// By the Stokes vector counted from the part of the y axis that is across the ray.
PolarizationLook look_of(const core::StokesVector& light) {
  constexpr double kMostly = 0.35;
  const core::Vec3& k = light.frame.k;
  const core::Vec3 across = core::Vec3::UnitY() - k.y() * k;
  if (std::abs(light.V) > 0.7 * light.I) return PolarizationLook::circular;
  if (across.norm() < 1e-6) return PolarizationLook::unpolarized;
  const double q = light.in_frame(across.normalized()).Q / light.I;
  if (q > kMostly) return PolarizationLook::along_y;
  return q < -kMostly ? PolarizationLook::along_x : PolarizationLook::unpolarized;
}

/// All that lies level: reflector sheets, bodies by their bottom and top faces, thin films.
std::vector<SectionLayer> layers_of(const tracer::Scene& scene) {
  std::vector<SectionLayer> layers;
  const auto& optics = scene.optics.front();
  const auto& quads = scene.caster->quads();
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const tracer::Surface& surface = optics.surfaces[i];
    if (std::abs(surface.normal.z()) < 0.5) continue;
    const double z = quads[i].corner.z();
    const double other = (quads[i].corner + quads[i].u + quads[i].v).z();  // of a wedge
    const std::string& name = scene.energy.parts()[static_cast<std::size_t>(surface.part)];
    const auto same = std::find_if(layers.begin(), layers.end(), [&](const SectionLayer& l) { return l.name == name; });
    if (surface.body >= 0 && same != layers.end()) {
      same->bottom = std::min({same->bottom, z, other});
      same->top = std::max({same->top, z, other});
      continue;
    }
    const LayerKind kind = surface.body >= 0                ? LayerKind::body
                           : name.starts_with("reflectors") ? LayerKind::reflector
                                                            : LayerKind::film;
    layers.push_back({name, kind, std::min(z, other), std::max(z, other)});
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const SectionLayer& a, const SectionLayer& b) { return a.bottom < b.bottom; });
  return layers;
}

design::SectionPath drawn(const tracer::PhotonPath& path) {
  design::SectionPath result;
  result.fate = path.fate;
  for (const tracer::PathVertex& vertex : path.vertices) {
    result.points.push_back({vertex.position.x(), vertex.position.z()});
    result.looks.push_back(look_of(vertex.light));
  }
  if (path.events > path.vertices.size()) {  // cut short: where it ended is not the next point
    result.looks.pop_back();
    result.fate = "goes on";
    return result;
  }
  core::Vec3 end = path.end;
  if (path.fate.starts_with("leaves by top")) end += 2.0 * path.vertices.back().light.frame.k;
  result.points.push_back({end.x(), end.z()});
  return result;
}

}  // namespace

design::SectionView section_view(const tracer::Scene& scene, const tracer::DensityField& density,
                                 const SectionOptions& options) {
  design::SectionView view;
  view.title = "The backlight in section";
  view.layers = layers_of(scene);
  const double height = scene.box.max.z() - scene.box.min.z();
  const double length = scene.box.max.x() - scene.box.min.x();
  view.x_min = options.from;
  view.x_max = options.to > options.from ? options.to : options.from + std::min(length, 12.0 * std::max(height, 1e-3));
  if (options.to <= options.from) view.x_min = std::max(scene.box.min.x(), options.from - 0.5 * height);
  const int tries = 50 * options.photons;
  for (int i = 0; i < tries && static_cast<int>(view.paths.size()) < options.photons; ++i) {
    const auto path = tracer::record_path(scene, density, options.key, static_cast<std::uint64_t>(i),
                                          static_cast<std::size_t>(options.most_events));
    const double start = path.vertices.front().position.x();
    const bool seen = start >= view.x_min - height && start <= view.x_max;
    if (seen || options.to > options.from) view.paths.push_back(drawn(path));
  }
  return view;
}

}  // namespace evenglow::app

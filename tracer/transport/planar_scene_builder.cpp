#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "tracer/transport/planar_scene.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

/// A quad whose edges run along two axes: the third, and the box that it spans (no thickness along that axis).
struct AxisQuad {
  int axis = 2;
  Box extent;
};

std::optional<AxisQuad> along_axes(const Quad& quad) {
  const auto axis_of_edge = [](const Vec3& edge) {
    int found = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (edge[axis] == 0.0) continue;
      if (found >= 0) return -1;
      found = axis;
    }
    return found;
  };
  const int u = axis_of_edge(quad.u);
  const int v = axis_of_edge(quad.v);
  if (u < 0 || v < 0 || u == v) return std::nullopt;
  const Vec3 opposite = quad.corner + quad.u + quad.v;
  return AxisQuad{3 - u - v, {quad.corner.cwiseMin(opposite), quad.corner.cwiseMax(opposite)}};
}

/// Planes nearer to each other (mm) are one: their places are sums of the same lengths in different order.
constexpr double kSamePlane = 1e-9;

bool same(double a, double b) {
  return std::abs(a - b) <= kSamePlane;
}

/// The same rectangle across `axis`?
bool spans(const Box& a, const Box& b, int axis) {
  for (int other = 0; other < 3; ++other) {
    if (other != axis && !(same(a.min[other], b.min[other]) && same(a.max[other], b.max[other]))) return false;
  }
  return true;
}

/// A film: a thin surface (no body), or a sheet.
struct Layer {
  double bottom = 0.0, top = 0.0;
  int bottom_quad = -1, top_quad = -1;
  int body = -1;
};

}  // namespace

class PlanarScene::Builder {
 public:
  explicit Builder(const Scene& scene) : scene_(scene), surfaces_(scene.optics.front().surfaces) {}

  std::optional<PlanarScene> build(std::string& reason) {
    try {
      result_.area_ = scene_.spec.area;
      result_.places_.resize(surfaces_.size());
      result_.room_of_body_.assign(scene_.optics.front().bodies.size(), kUnknown);
      find_bodies();
      for (std::size_t quad = 0; quad < surfaces_.size(); ++quad) {
        if (surfaces_[quad].body < 0) add_sheet(static_cast<int>(quad));
      }
      pile_up();
      return std::move(result_);
    } catch (const NotPlanar& fault) {
      reason = fault.reason;
      return std::nullopt;
    }
  }

 private:
  struct NotPlanar {
    std::string reason;
  };

  AxisQuad extent_of(int quad) const {
    const auto found = along_axes(scene_.caster->quads()[static_cast<std::size_t>(quad)]);
    const Surface& surface = surfaces_[static_cast<std::size_t>(quad)];
    if (!found || surface.is_trimmed()) {
      throw NotPlanar{fmt::format("a face of {} is neither parallel nor square to the layers",
                                  scene_.energy.parts()[static_cast<std::size_t>(surface.part)])};
    }
    return *found;
  }

  void find_bodies() {
    const std::size_t count = scene_.optics.front().bodies.size();
    std::vector<PlanarRoom> bodies(count);
    for (std::size_t quad = 0; quad < surfaces_.size(); ++quad) {
      const int body = surfaces_[quad].body;
      if (body < 0) continue;
      const AxisQuad face = extent_of(static_cast<int>(quad));
      const bool upper = surfaces_[quad].normal[face.axis] > 0.0;
      PlanarRoom& room = bodies[static_cast<std::size_t>(body)];
      room.body = body;
      room.quads[2 * static_cast<std::size_t>(face.axis) + (upper ? 1 : 0)] = static_cast<int>(quad);
      (upper ? room.box.max : room.box.min)[face.axis] = face.extent.min[face.axis];
    }
    for (std::size_t body = 0; body < count; ++body) add_body(bodies[body]);
  }

  void add_body(const PlanarRoom& room) {
    for (const int quad : room.quads) {
      if (quad < 0) throw NotPlanar{"a body is no box"};
    }
    if (scene_.spec.plate && room.body == 0) {
      result_.plate_ = room;
      for (const int quad : room.quads) place(quad).is_plate = true;
      return;
    }
    if (!spans(room.box, scene_.box, 2)) throw NotPlanar{"a sheet does not fill the room between the walls"};
    for (std::size_t side = 0; side < 4; ++side) place(room.quads[side]).is_sheet_side = true;
    layers_.push_back({room.box.min.z(), room.box.max.z(), room.quads[4], room.quads[5], room.body});
    bodies_.push_back(room);
  }

  /// A reflector, a film without thickness, or the window of a source.
  void add_sheet(int quad) {
    const AxisQuad sheet = extent_of(quad);
    const int axis = sheet.axis;
    const double at = sheet.extent.min[axis];
    if (spans(sheet.extent, scene_.box, axis)) {
      const bool lower = same(at, scene_.box.min[axis]);
      const bool upper = same(at, scene_.box.max[axis]);
      const bool is_film = axis == 2 && !is_reflector(quad);
      if (!is_film && (lower || upper)) {
        result_.walls_[2 * static_cast<std::size_t>(axis) + (lower ? 0 : 1)] = quad;
        place(quad).is_wall = axis != 2;
        return;
      }
      if (axis == 2) {
        layers_.push_back({at, at, quad, quad, -1});
        return;
      }
    }
    const Box& area = scene_.spec.area;
    const bool below = at <= area.min[axis];
    const bool above = at >= area.max[axis] && axis != 2;
    if (!below && !above) throw NotPlanar{"a source stands in the way of the layers"};
    result_.free_sources_[2 * static_cast<std::size_t>(axis) + (below ? 0 : 1)] = true;
    result_.has_free_sources_ = true;
    // Where it is left to, only the general search can tell.
    place(quad).below = place(quad).above = kUnknown;
    if (axis != 2) place(quad).is_wall = false;
  }

  bool is_reflector(int quad) const {
    return scene_.energy.parts()[static_cast<std::size_t>(surfaces_[static_cast<std::size_t>(quad)].part)].rfind(
               "reflectors.", 0) == 0;
  }

  void pile_up() {
    std::stable_sort(layers_.begin(), layers_.end(),
                     [](const Layer& a, const Layer& b) { return a.bottom < b.bottom; });
    double z = scene_.box.min.z();
    int quad = result_.walls_[4];
    for (const Layer& layer : layers_) {
      if (layer.bottom < z - kSamePlane) throw NotPlanar{"layers lie in one another"};
      if (result_.plate_ && layer.bottom < result_.plate_->box.max.z() - kSamePlane)
        throw NotPlanar{"a layer lies below the plate"};
      add_air(z, layer.bottom, quad, layer.bottom_quad);
      if (layer.body >= 0) {
        const auto body = std::find_if(bodies_.begin(), bodies_.end(),
                                       [&](const PlanarRoom& room) { return room.body == layer.body; });
        result_.room_of_body_[static_cast<std::size_t>(layer.body)] = static_cast<int>(result_.rooms_.size());
        result_.rooms_.push_back(*body);
      }
      z = layer.top;
      quad = layer.top_quad;
    }
    const int top = result_.walls_[5];
    if (layers_.empty() || top >= 0 || scene_.box.max.z() > z + kSamePlane) {
      add_air(z, scene_.box.max.z(), quad, top);
    } else if (quad >= 0) {
      place(quad).above = kOutside;
    }
    if (result_.walls_[4] >= 0) place(result_.walls_[4]).below = kOutside;
    if (top >= 0) place(top).above = kOutside;
    if (layers_.empty() && !result_.plate_) throw NotPlanar{"there is neither a plate nor a film"};
  }

  void add_air(double bottom, double top, int bottom_quad, int top_quad) {
    PlanarRoom room{scene_.box, -1, result_.walls_};
    room.box.min.z() = bottom;
    room.box.max.z() = top;
    room.quads[4] = bottom_quad;
    room.quads[5] = top_quad;
    const int index = static_cast<int>(result_.rooms_.size());
    if (bottom_quad >= 0) place(bottom_quad).above = index;
    if (top_quad >= 0) place(top_quad).below = index;
    result_.rooms_.push_back(room);
  }

  Place& place(int quad) { return result_.places_[static_cast<std::size_t>(quad)]; }

  const Scene& scene_;
  const std::vector<Surface>& surfaces_;
  PlanarScene result_;
  std::vector<Layer> layers_;
  std::vector<PlanarRoom> bodies_;
};

std::optional<PlanarScene> PlanarScene::of(const Scene& scene, std::string* reason) {
  std::string why;
  auto result = Builder(scene).build(why);
  if (reason != nullptr) *reason = why;
  return result;
}

}  // namespace evenglow::tracer

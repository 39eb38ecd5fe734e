#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tracer/geometry/mesh.h"
#include "tracer/scene/backlight_spec.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// Lays out the plate, its reflectors, films and sources for one wavelength (nm): quads with the surface of each.
/// Quads, parts and source placements are the same at every wavelength, the optics are not; `spec` must outlive the
/// builder and the optics taken from it. The `take_` functions move a list out: once each.
class SceneBuilder {
 public:
  SceneBuilder(const BacklightSpec& spec, double wavelength);

  /// The room between the reflectors, mm.
  const Box& box() const { return box_; }
  SceneOptics take_optics() { return std::move(optics_); }
  std::vector<Quad> take_quads() { return std::move(quads_); }
  std::vector<std::string> take_parts() { return std::move(parts_); }
  std::vector<SourcePlacement> take_source_placements() { return std::move(source_placements_); }

 private:
  int part(std::string name);
  int add(const Quad& quad, Surface surface);
  /// The room between the reflectors; the top film closes it.
  Box interior() const;
  /// `lift`: of a wedge, see `side_of_wedge`.
  void add_body(const Box& place, const Body& body, double lift = 0.0);
  void add_plate();
  void serrate(const EntranceTexture& texture, double index);
  void add_reflector(Side side);
  /// The film at this wavelength; a surface made for it is owned by the optics.
  std::pair<const Bsdf*, std::optional<DielectricSheet>> optics_of(const Film& film);
  void add_films();
  /// A source that is a body stands in the way: as a window of the reflector if both lie in one plane, else before it.
  void add_source(std::size_t index);

  const BacklightSpec& spec_;
  double wavelength_;
  Box box_;
  std::vector<Quad> quads_;
  SceneOptics optics_;
  std::vector<std::string> parts_;
  std::vector<SourcePlacement> source_placements_;
  std::array<int, kSides> reflector_quads_{-1, -1, -1, -1, -1, -1};
};

}  // namespace evenglow::tracer

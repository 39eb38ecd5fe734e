#pragma once

#include <vector>

#include "core/math/vec3.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// A horizontal border between the viewer and what lies deepest: the bottom reflector, a face of the plate or of a
/// sheet, a thin film.
struct ViewerLevel {
  int quad = -1;
  double z = 0.0;                                             ///< mm
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;  ///< where it may be met, mm
  int body_above = -1;                                        ///< the body between it and the next level, -1: air
  bool outer = false;      ///< its rectangle is that of the films, else that of the plate
  bool patterned = false;  ///< the density field rules a microstructure on it
  bool windowed = false;   ///< parts of it have optics of their own
  bool joined = false;     ///< what its base scatters may be estimated: it has a lobe wide enough
  bool recorded = false;   ///< light is estimated here, so that arrivals of the viewer's subpaths are kept
  bool primary = false;    ///< what it scatters is always estimated: subpaths go on by its specular part only

  bool holds(const core::Vec3& p) const { return p.x() >= min_x && p.x() <= max_x && p.y() >= min_y && p.y() <= max_y; }
};

/// The levels that can be reached from the viewer through levels alone, from below upwards: down to the bottom, or to
/// the first thing that is no parallel layer (the tilted bottom of a wedge, a source that stands in the room).
class ViewerLevels {
 public:
  explicit ViewerLevels(const Scene& scene);

  const std::vector<ViewerLevel>& all() const { return levels_; }
  const ViewerLevel& operator[](int level) const { return levels_[static_cast<std::size_t>(level)]; }
  int top() const { return static_cast<int>(levels_.size()) - 1; }
  /// Level of a quad, -1: none.
  int of_quad(int quad) const { return of_quad_[static_cast<std::size_t>(quad)]; }

 private:
  void find(const Scene& scene);
  void leave_narrow_lobes(const Scene& scene);
  void cut_below_obstacles(const Scene& scene);
  void leave_room_for_sources(const Scene& scene);
  void choose_primary(const Scene& scene);

  std::vector<ViewerLevel> levels_;
  std::vector<int> of_quad_;
};

}  // namespace evenglow::tracer

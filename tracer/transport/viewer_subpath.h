#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/scene/density_field.h"
#include "tracer/transport/viewer_levels.h"

namespace evenglow::tracer {

/// A rectangle of places relative to a point, mm; at first it holds none.
struct PlaceRange {
  core::Vec2 min = core::Vec2::Constant(std::numeric_limits<double>::infinity());
  core::Vec2 max = core::Vec2::Constant(-std::numeric_limits<double>::infinity());
};

/// Where a path from the viewer meets a level that can scatter light into it. Places are relative to the meeting, so
/// that the path fits every place of the level.
struct ViewerArrival {
  core::StokesVector importance;   ///< (reversed_bsdf.h) for light that leaves the level, per unit of radiance / n^2
  View view{core::Vec3::UnitZ()};  ///< the direction it started from
  core::Vec2 display = core::Vec2::Zero();  ///< place where the light leaves the backlight
  PlaceRange inner, outer;                  ///< of all later meetings with the plate and with the films around it
  PlaceRange fits;  ///< places of the level from which all of these lie within their borders (`NextEvent`)
  std::size_t first_crossing = 0, crossings = 0;  ///< passages of the patterned face beside its pattern
};

/// A passage of the patterned face beside its pattern.
struct PatternCrossing {
  core::Vec2 place;  ///< relative to the arrival
  core::Vec3 k;      ///< along which the light comes to the face
};

/// What subpaths found: arrivals of each level, apart for light that leaves it downwards and upwards.
struct ViewerArrivals {
  explicit ViewerArrivals(std::size_t levels) : lists(2 * levels) {}
  static std::size_t list(int level, bool upward) { return 2 * static_cast<std::size_t>(level) + (upward ? 1 : 0); }

  std::vector<std::vector<ViewerArrival>> lists;  ///< by `list`
  std::vector<PatternCrossing> crossings;
  void clear();
};

/// Random walk from the viewer down through the levels, against the way of light: at each level it goes on by what the
/// surface does to light (`step_back`), at a primary level by its specular part only, until it is absorbed, leaves the
/// stack or comes to an end. All meetings with levels that scatter are recorded. The expected sum over arrivals of
/// importance . (scattered light) / n^2 is the luminance that the scattered light gives (docs/theory.md).
class ViewerSubpath {
 public:
  ViewerSubpath(const Scene& scene, const ViewerLevels& levels) : scene_(scene), levels_(levels) {}

  void add(const View& view, std::size_t band, core::PhotonRng& rng, ViewerArrivals& arrivals) const;

 private:
  struct Walk;
  bool fly(Walk& walk, int level, std::size_t band) const;
  void record(const Walk& walk, const View& view, ViewerArrivals& arrivals) const;
  bool pass(Walk& walk, std::size_t band, core::PhotonRng& rng) const;

  const Scene& scene_;
  const ViewerLevels& levels_;
};

}  // namespace evenglow::tracer

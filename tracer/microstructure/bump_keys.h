#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/config/config_node.h"
#include "tracer/microstructure/bump_placement.h"
#include "tracer/microstructure/microstructure.h"
#include "tracer/microstructure/traced_bump.h"

/// Keys that the clear shapes share.
namespace evenglow::tracer {

/// Keys `form` (raised, sunk) and, of shapes that have one, `axis_deg`; the face is that of the pattern.
BumpPlacement read_placement(const core::ConfigNode& node);
BumpPlacement read_placement(const core::ConfigNode& node, const char* axis_help, double default_axis_deg);

/// The steepness of straight flanks and what is cut off their tip.
struct Flank {
  double angle = 0.0;       ///< rad, between flank and face
  double truncation = 0.0;  ///< width of the flat top over that of the footprint, in [0, 1)
};

/// Keys `flank_deg` or `aspect` (height over width of the footprint), and `truncation`.
Flank read_flank(const core::ConfigNode& node);

/// Key `fill`: share of the patterned area under footprints, to `greatest` or 1.
double read_fill(const core::ConfigNode& node, double greatest);
/// Of round footprints in a square pattern, rounded down from pi/4.
inline constexpr double kRoundFill = 0.785;

/// Steepest flank of all shapes, degrees.
inline constexpr double kSteepest = 85.0;

template <typename Shape>
Microstructure bump_of(std::string kind, const Shape& shape, const BumpPlacement& placement, double fill) {
  return {std::move(kind),
          [shape, placement](double plate_index) -> std::unique_ptr<const Bsdf> {
            return std::make_unique<TracedBump<Shape>>(shape, placement, plate_index);
          },
          fill};
}

}  // namespace evenglow::tracer

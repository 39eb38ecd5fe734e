#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/config/config_node.h"
#include "core/dots/dot.h"
#include "design/dots/keep_out.h"

namespace evenglow::design {

/// How a density becomes dots.
enum class DotMode {
  spacing,  ///< dots of one size, their spacing follows the density: blue noise
  lattice,  ///< a lattice of one pitch, the size follows the density
  both      ///< blue noise whose size and spacing follow the density
};

enum class DotLattice { square, hexagonal };

/// A periodic part above the pattern that it can beat with: panel or prism film.
struct GratingSpec {
  double pitch_x = 0.0;  ///< mm, along its own x
  double pitch_y = 0.0;  ///< mm, along its own y; 0: lines without a period there
  double angle = 0.0;    ///< rad, of its own x from +x towards +y
};

/// What the maker's process does to the dots beyond the drawing.
struct ProcessSpread {
  double bias = 0.0;             ///< mm, every diameter grows by it
  double size_spread = 0.0;      ///< mm, standard deviation of the diameter
  double position_spread = 0.0;  ///< mm, standard deviation of x and of y
};

/// The map `dots` of the run file; lengths in mm, angles in rad.
struct DotSpec {
  DotMode mode = DotMode::spacing;
  double diameter = 0.06;      ///< of every dot, mode spacing
  double diameter_min = 0.03;  ///< process limits; mode both: of the least and the greatest density
  double diameter_max = 0.1;
  double gap = 0.01;    ///< least clear distance between two dots
  double pitch = 0.12;  ///< of the lattice: distance of nearest places
  DotLattice lattice = DotLattice::square;
  double lattice_angle = 0.0;
  double size_step = 0.0005;  ///< sizes are whole multiples of it
  double angle = 0.0;         ///< of every dot's own axis
  core::Footprint footprint = core::Footprint::round;
  std::uint64_t seed = 1;
  bool accept_shortfall = false;  ///< place what the limits allow where the density asks for more
  Margins margins;
  std::vector<RectangleZone> rectangles;
  std::vector<CircleZone> circles;
  std::optional<GratingSpec> panel;
  double viewing_distance = 350.0;  ///< mm, for what the eye sees of a beat
  ProcessSpread process;
};

/// Reads and checks the map `dots`; an absent one gives the defaults. `default_footprint`: of the shape of the pattern.
DotSpec read_dots(const core::ConfigNode& dots, core::Footprint default_footprint);

}  // namespace evenglow::design

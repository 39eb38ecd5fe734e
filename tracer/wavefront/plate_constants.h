#pragma once

#include <array>
#include <vector>

namespace evenglow::tracer {

/// A reflector of the kind `OpaqueReflector` as the kernel sees it; `known` 0: there is none, or one of another kind.
struct FlatReflector {
  double known = 0.0;
  double reflectance = 0.0;
  double mirrored = 0.0;  ///< share of the incident light
  double part = 0.0;
  double gap = 0.0;  ///< mm of air up to it
};

/// The plate as the kernel sees it; arrays of walls by side, 0 to 3.
struct PlateConstants {
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0, min_z = 0.0, max_z = 0.0;  ///< mm
  double index = 1.5, per_index = 1.0 / 1.5;
  double height = 1.0, per_height = 1.0;
  double absorption = 0.0;      ///< 1/mm
  double per_absorption = 0.0;  ///< mm; 1e30 where nothing is absorbed
  double part = 0.0;            ///< of the plate's bulk
  bool open_above = false;      ///< light that leaves the top meets nothing more
  double most_events = 1e6;

  int pattern_side = -1;  ///< 4: bottom, 5: top, -1: none
  FlatReflector dots;     ///< `known` 0: microstructure of another kind
  FlatReflector below;    ///< the sheet below the plate

  bool all_smooth = true;
  std::array<double, 4> smooth{};  ///< 1: this wall is a smooth face
  std::array<double, 4> backing_known{}, backing_reflectance{}, backing_mirrored{}, backing_part{}, backing_gap{};

  // Cells of the density: nearest cell to x, y is ((x - x0) per_x, (y - y0) per_y), rounded down.
  double x0 = 0.0, y0 = 0.0, per_x = 1.0, per_y = 1.0;
  int nx = 1, ny = 1;
  std::vector<float> open{1.0F};  ///< 1 - density of each cell
};

}  // namespace evenglow::tracer

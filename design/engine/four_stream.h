#pragma once

#include <array>
#include <vector>

#include "core/math/cell_field.h"

/// Guided light in a plate as four streams along +x, -x, +y, -y: the two-stream picture (flux along the plate decays by
/// what is let out) for LEDs at any edges.
namespace evenglow::design {

/// What enters through an edge and what comes back from it.
struct StreamEdge {
  std::vector<double> inflow;  ///< flux into each cell along the edge, any unit; empty: none
  double reflectance = 0.0;
};

/// A plate with its pattern. A stream phi that crosses a cell of length h loses phi (1 - exp(-rate density h)) to the
/// pattern: the share `out` of that leaves the plate there, the rest goes on in all four directions alike. Sideways
/// each stream spreads by a random walk whose variance is `spread` times the way.
struct StreamPlate {
  core::CellGrid cells;
  std::array<StreamEdge, 4> edges;  ///< left, right, front, back
  std::vector<double> rate;         ///< 1/mm at density 1, of each column
  double out = 0.45;
  double spread = 0.2;  ///< mm
  double inside = 0.0;  ///< flux that enters each cell from below or above
};

/// Flux that leaves each cell, after `sweeps` passes of the streams through the plate.
core::CellField stream_light(const StreamPlate& plate, const core::CellField& density, int sweeps = 400);

/// The density of mean `level` whose light has the shape `target` (any unit): streams and ratio updates converge
/// together. Densities stay in [least, largest].
core::CellField stream_density(const StreamPlate& plate, const core::CellField& target, double level, double least,
                               double largest, int sweeps = 400);

}  // namespace evenglow::design

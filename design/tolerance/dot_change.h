#pragma once

#include "core/dots/dot.h"
#include "core/math/cell_field.h"
#include "core/montecarlo/photon_rng.h"
#include "design/dots/dot_spec.h"

/// What a process that misses its drawing does to the density of dots.
namespace evenglow::design {

/// The dots that a density stands for.
struct DotModel {
  core::Footprint footprint = core::Footprint::round;
  core::CellField diameter;  ///< mm, of the dots of each cell
  double fill = 1.0;         ///< coverage for a density of 1
};

/// The dots that `evenglow dots` would place for the density: their diameter by the mode (fixed, by the lattice's
/// pitch, or by the size law).
DotModel dot_model(const core::CellField& density, double fill, const DotSpec& spec);

/// How the dots of one sample miss the drawing.
struct DotChange {
  core::CellField growth;     ///< mm, of the diameters, on the cells of the density
  double size_spread = 0.0;   ///< mm, standard deviation of a dot's diameter besides
  double place_spread = 0.0;  ///< mm, standard deviation of a dot's x and of its y
};

/// The density of the sample, from 0 to 1. With d the drawn diameter of a cell, g the growth, s the spread of sizes and
/// a the area of one dot, a cell of area A at the coverage c
/// - is covered ((d + g)^2 + s^2) / d^2 times as much on average (0 where dots vanish);
/// - scatters by its finite number of dots N = c A / a: the variance of its coverage is c a / A times that of
///   ((d + g + s z) / d)^2, which is (4 (d + g)^2 s^2 + 2 s^4) / d^4;
/// - and exchanges area with each neighbor, as dots move over the common border of length L: an area with the variance
///   L c / a times `exchange` of the dots (they do not leave the plate, and the area in all stays).
/// Numbers are taken from both generators for every cell, whatever the spreads are.
core::CellField changed_density(const core::CellField& density, const DotModel& model, const DotChange& change,
                                core::PhotonRng& sizes, core::PhotonRng& places);

/// For dots of one width (mm) with one in each unit of area: variance of the area (mm2) beyond a line, for each mm of
/// it, when their places scatter by `spread` (mm) about fixed ones: half the mean of G(t) over the difference t of two
/// shifts, where G(t) is the integral over x of (F(x + t) - F(x))^2 and F(x) the area of a dot at x beyond the line.
/// F is taken as a ramp: of the width of a square (exact), of 3 pi^2 / 16 of a disc's radius (exact for small shifts).
double exchange(core::Footprint footprint, double diameter, double spread);

}  // namespace evenglow::design

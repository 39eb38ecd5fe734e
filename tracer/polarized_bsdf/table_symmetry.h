#pragma once

#include <cstddef>

#include "tracer/polarized_bsdf/bsdf_table.h"

namespace evenglow::tracer {

/// Comparison of a node with another place of the table that must hold the same S.
struct NodeComparison {
  std::size_t psi = 0, sigma = 0, phi = 0, theta = 0, lambda = 0;  ///< indices into the axes
  double ratio = 1.0;                                              ///< S here over S there
};

/// Agreement over all comparable nodes of a kind.
struct Agreement {
  std::size_t pairs = 0;         ///< without those where both are 0
  double mean_difference = 0.0;  ///< sum w |S - S'| / sum w (S + S')/2, w the projected solid angles of the node
  NodeComparison worst;          ///< the largest |ln ratio|
};

/// Reciprocity of the first Mueller element. Light path reversed: incident along the outgoing direction, outgoing along
/// the incident one; a film that is the same from both sides and after half a turn about its normal (DBEF is) has
/// S(in -> out) = S(out -> in). Compared are the nodes above the horizon whose outgoing polar angle is at most the last
/// sigma node; the other value is interpolated (one incidence per node pair, so agreement is that of the interpolation,
/// a few percent, not of rounding).
Agreement reciprocity(const BsdfTable& table, ScatterKind kind);

/// Mirror symmetry y -> -y: S(psi, phi) = S(-psi, -phi).
Agreement mirror_symmetry(const BsdfTable& table, ScatterKind kind);

}  // namespace evenglow::tracer

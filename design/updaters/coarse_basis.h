#pragma once

#include <cstdint>
#include <vector>

#include "core/math/cell_field.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::design {

/// Smooth directions in ln density: nx x ny nodes evenly over the plate, each with a tent (bilinear, 1 at the node, 0
/// at its neighbors; constant beyond the outermost nodes), so that all of them add up to 1 everywhere.
class CoarseBasis {
 public:
  CoarseBasis(const core::CellGrid& cells, int nx, int ny);

  std::size_t count() const { return nodes_.size(); }
  const tracer::DirectionSet& directions() const { return directions_; }
  /// The nodes' values between the nodes.
  core::CellField field(const std::vector<double>& values) const;
  /// Means of a field on the same cells, weighted by the tents.
  std::vector<double> means(const core::CellField& field) const;
  /// The rectangle of the nodes, each with the cells of the display whose centers it holds.
  std::vector<std::uint32_t> nearest_node(const core::CellGrid& display) const;

 private:
  core::CellGrid cells_, nodes_;
  tracer::DirectionSet directions_;
};

}  // namespace evenglow::design

#pragma once

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"

namespace evenglow::design {

/// How large the dots of the blue-noise modes are where the coverage is so high, and so how far apart.
class SizeLaw {
 public:
  /// Mode spacing: one diameter. Mode both: from the least to the greatest diameter, its logarithm linear in that of
  /// the coverage between the least and the greatest cell; 3 % within these limits, if there is room, so that the
  /// dots of a cell can be set right.
  SizeLaw(const DotSpec& spec, const CoverageMap& map);

  double diameter(double coverage) const;  ///< mm
  /// Area (mm2) under one dot.
  double area(double coverage) const;
  /// Distance (mm) of a dot's neighbors on average: root of the plate's area for each dot; at most `widest()`.
  double spacing(double coverage) const;
  double widest() const { return widest_; }

 private:
  core::Footprint footprint_;
  double least_, greatest_;
  double low_ = 0.0, exponent_ = 0.0;
  double widest_;
};

}  // namespace evenglow::design

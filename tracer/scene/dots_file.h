#pragma once

#include <memory>
#include <string>

#include "core/config/config_node.h"
#include "tracer/microstructure/dot_grid.h"

namespace evenglow::tracer {

/// The keys `dots_file` and `footprint` of the map `microstructure`: the pattern dot by dot, from a CSV or DXF file (as
/// `core::read_dot_csv`, `core::read_dot_dxf`); null without. `shape`: kind of the microstructure. Faults are noted:
/// the files' own, dots that reach beyond the face, shapes with a height that overlap, keys that contradict.
std::shared_ptr<const DotGrid> read_dots_file(const core::ConfigNode& microstructure, const std::string& shape,
                                              const FaceArea& face);

/// The outline of dots of this shape if nothing else is said.
core::Footprint usual_footprint(const std::string& shape);

/// Throws ConfigError (`name`: of the file) for a dot that reaches beyond the face.
void check_within(const core::DotPattern& dots, core::Footprint footprint, const FaceArea& face,
                  const std::string& name);

}  // namespace evenglow::tracer

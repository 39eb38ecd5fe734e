#pragma once

#include "core/config/config_node.h"
#include "design/problem/design_spec.h"

/// The keys of the map `design` that may be a word or a map.
namespace evenglow::design {

/// `target: uniform`, `{kind: center_weighted, corner: 0.8}`, `{csv: FILE}` or `{png: FILE}`.
TargetSpec read_target(const core::ConfigNode& design);

/// `start: flat`, `analytic`, `{file: density.csv}` or `{result: DIR}`.
StartSpec read_start(const core::ConfigNode& design);

/// `goal` and `subject_to`.
GoalSpec read_goal(const core::ConfigNode& design);

/// The CSV matrix that the key names; empty if it is absent or at fault.
MapTable read_map_key(const core::ConfigNode& node, const core::TextKey& key, const core::MatrixRange& range);

}  // namespace evenglow::design

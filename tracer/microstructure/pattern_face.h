#pragma once

#include "core/config/config_node.h"

namespace evenglow::tracer {

/// The key `face` of the pattern: is it on the plate's top face? Asked by the pattern as a whole and by shapes whose
/// axis depends on it.
inline bool read_pattern_on_top(const core::ConfigNode& node) {
  return node.choice({"face", "patterned face", {"bottom", "top"}, "bottom"}) == "top";
}

}  // namespace evenglow::tracer

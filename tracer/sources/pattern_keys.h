#pragma once

#include "core/config/config_node.h"
#include "tracer/sources/emission_pattern.h"

namespace evenglow::tracer {

/// Reads the keys of an angular pattern; faults are noted at the node, which then gets a Lambertian one.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | pattern | `lambertian`; `cosine_power` (or `cos_n`): I ~ cos^n; `tabulated`, `ies`, `eulumdat`: from a file |
/// lambertian | | exponent | `cosine_power`: n | 1 | | half_angle_deg | `cosine_power`, instead of n: where the
/// intensity has fallen to one half | | | pattern_file | the file of the other three | required | | pattern_turn_deg |
/// of the other three: turns the pattern about the normal, counterclockwise seen from behind | 0 |
EmissionPattern read_emission_pattern(const core::ConfigNode& node);

/// What a reader should know of a pattern that does not emit all that its file holds; else empty.
std::string pattern_note(const EmissionPattern& pattern);

}  // namespace evenglow::tracer

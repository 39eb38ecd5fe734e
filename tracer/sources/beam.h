#pragma once

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// A collimated beam onto the middle of a face, uniform over its cross section.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | face | face that is lit: left, right, front, back, bottom or top | bottom |
/// | angle_deg | angle of incidence | 0 |
/// | plane_deg | azimuth of the plane of incidence in the face, from its first axis (x; y for left and right) | 0 |
/// | polarization | none, linear, circular (right) | none |
/// | azimuth_deg | linear only: direction of the field, from the plane of incidence (0: p, 90: s) | 0 |
/// | size_share | lit share of the face's length and width, around its center | 0.2 |
/// | gap_mm | air between source and face | 0 |
/// | flux_lm | luminous flux | 100 |
SourceSpec make_beam(const core::ConfigNode& node);

}  // namespace evenglow::tracer

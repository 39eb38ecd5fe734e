#pragma once

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// Measured or simulated rays of a file (IES TM-25, Zemax binary), drawn with the odds of their flux, at one or more
/// places along a face; light passes the source unhindered.
///
/// The file's frame stands at each place with its `axis` along the normal into the backlight and, with the axis +z, its
/// y axis up (+z of the backlight for a side, +y for bottom and top); `turn_deg` turns it about the normal. A ray
/// starts where its line crosses the plane at `gap_mm` before the face; what goes away from the backlight is left out.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | file | the ray file | required |
/// | format | auto, tm25 or zemax | auto |
/// | face | left, right, front, back, bottom or top | left |
/// | axis | axis of the file that points into the backlight: +x, -x, +y, -y, +z, -z | +z |
/// | turn_deg | turns the file about the normal, from its x axis towards its y axis | 0 |
/// | origin_mm | point of the file's frame that lies at the place, on the plane | [0, 0, 0] |
/// | count, pitch_mm | number of places and their distance, centered on the face | 1, face / count |
/// | at_mm | the places along the face (y for left and right, else x), instead of count and pitch_mm | |
/// | across_mm | the places across it (z; y for bottom and top) | middle |
/// | gap_mm | air between the plane and the face | 0.02 |
/// | flux_lm | luminous flux of each place | that of the file's rays that go into the backlight |
SourceSpec make_ray_file(const core::ConfigNode& node);

}  // namespace evenglow::tracer

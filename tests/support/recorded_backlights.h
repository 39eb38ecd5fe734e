#pragma once

#include <string>

/// Backlights whose histories are kept, in YAML's flow style as `scene_of` takes it.
namespace evenglow::tests {

/// White dots over a white sheet, diffuser and reflective polarizer: the next-event estimate with estimates of dots
/// that are not met, of the sheet below (through the pattern), images in walls, and photons that are counted.
inline const std::string kRecordedDots =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [8, 4], density: "
    "0.2, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 2, reflectance: 0.5}], reflectors: "
    "{bottom: {}, right: {}, front: {}}, films: [{kind: diffuser}, {kind: dbef}], receivers: [{kind: luminance, cells: "
    "[8, 4], cone_deg: 30}]";

/// A pattern that refracts: no Lambertian scatter anywhere but in the diffuser.
inline const std::string kRecordedLenses =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [8, 4], density: "
    "0.2, kind: microlens}, sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: {}}, films: [{kind: "
    "diffuser}], receivers: [{kind: luminance, cells: [8, 4], cone_deg: 30}]";

}  // namespace evenglow::tests

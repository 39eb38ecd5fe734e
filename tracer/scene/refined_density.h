#pragma once

#include "tracer/scene/backlight_spec.h"
#include "tracer/scene/density_field.h"

/// A density that runs linearly between the centers of its cells.
namespace evenglow::tracer {

/// The field on `subcells` x `subcells` equal parts of each cell, 1 or more: bilinear between the centers of the cells
/// (beyond the outermost centers constant), shifted within each cell so that its mean stays what it was, exactly. Where
/// a part would pass the least or the greatest density of the field, the differences within its cell shrink.
DensityField refined(const DensityField& density, int subcells);

/// What is traced of a density on the cells of the backlight's microstructure: refined, if it asks for that.
DensityField traced_density(const BacklightSpec& spec, const DensityField& density);

}  // namespace evenglow::tracer

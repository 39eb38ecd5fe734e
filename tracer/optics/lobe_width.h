#pragma once

#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// Does the surface scatter natural light that meets it along its normal over more than about the half angle `least`
/// (rad, below pi/2)? On average over eight azimuths `evaluate` at `least` from the straight way must be at least a
/// twelfth of that on it: of a Gaussian lobe, a full width at half maximum of at least 1.05 `least`. A surface that
/// passes light is judged by what it passes, another by what it reflects.
bool spreads_over(const Bsdf& surface, double least);

}  // namespace evenglow::tracer

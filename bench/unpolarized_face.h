#pragma once

#include "bench/bench_scene.h"

namespace evenglow::bench {

/// The scene with smooth faces that know no polarization: natural Fresnel reflectance, no Stokes vector, no frame. What
/// the walk saves by them is the cost of polarization in its optics.
void forget_polarization(BenchScene& bench);

}  // namespace evenglow::bench

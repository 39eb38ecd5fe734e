#pragma once

#include <string>

#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"

/// The backlights that are measured.
namespace evenglow::bench {

struct BenchScene {
  tracer::Scene scene;
  tracer::DensityField density;
};

/// S1: 100 x 60 x 3 mm PMMA slab, white dots whose density rises along x from 0.04 to 0.40, mirrors (.98) at the four
/// edges, white sheet (.98) below, Lambertian light at the left end face.
BenchScene slab_scene();

/// S2: S1 under a diffuser and the tabulated DBEF of configs/data. `estimator` of the luminance: next_event or counting
/// (10 degree cone, 96 x 48 cells, as the default pattern has).
BenchScene film_scene(const std::string& estimator = "next_event");

/// As S2, with the ideal, specular DBEF: the diffuser is the topmost film that scatters.
BenchScene ideal_film_scene(const std::string& estimator);

/// The maps of `films:` that are measured one by one.
tracer::BacklightSpec film_samples();

}  // namespace evenglow::bench

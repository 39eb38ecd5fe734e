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
BenchScene slab_scene(const std::string& estimator = "counting");

/// S2 without its prism films: S1 under a diffuser and the tabulated DBEF of configs/data. `estimator` of the
/// luminance: next_event or counting (10 degree cone, 96 x 48 cells, as the default pattern has).
BenchScene film_scene(const std::string& estimator = "next_event");

/// S2: the same with crossed prism films between diffuser and DBEF.
BenchScene prism_scene(const std::string& estimator);

/// As `film_scene`, with the ideal, specular DBEF: the diffuser is the topmost film that scatters.
BenchScene ideal_film_scene(const std::string& estimator);

/// The slab of S1, lossless, with nothing on or around it.
BenchScene bare_slab_scene();

/// S1 changed: number of cells, thickness (mm), all densities times `density`, and the first so many of diffuser, two
/// crossed prism films and ideal DBEF on it; luminance counted.
struct SceneOptions {
  int nx = 100, ny = 60;
  double thickness = 3.0;
  double density = 1.0;
  int films = 0;
};
BenchScene scene_with(const SceneOptions& options);

/// The maps of `films:` that are measured one by one.
tracer::BacklightSpec film_samples();

}  // namespace evenglow::bench

#include "bench/walker.h"
#include "bench/yardstick.h"
#include <benchmark/benchmark.h>

namespace evenglow::bench {
namespace {

/// Photons of a slice of some milliseconds, as the others are: shorter ones would count the filling of the caches.
constexpr std::uint64_t kPlatePhotons = 8000, kFilmPhotons = 2000;

/// The planar path, slice by slice with the general path and the yardstick: all see the same clock rate and neighbors.
void planar_walk(benchmark::State& state, MeasuredScene& scene, std::uint64_t photons) {
  PlanarWalker planar(scene.bench);
  GeneralWalker general(scene.bench);
  scene.yardstick.reset();
  for (auto _ : state) {
    planar.slice(photons);
    general.slice();
    scene.yardstick.measure();
  }
  state.counters["event_ns"] = 1e9 * planar.seconds_per_event();
  state.counters["event_per_R"] = planar.seconds_per_event() / scene.yardstick.seconds();
  state.counters["photons_per_s"] = 1.0 / planar.seconds_per_photon();
  state.counters["general_event_per_R"] = general.seconds_per_event() / scene.yardstick.seconds();
  state.counters["events_per_photon"] = planar.events_per_photon();
  state.counters["gain"] = general.seconds_per_photon() / planar.seconds_per_photon();
}

void slab_planar(benchmark::State& state) {
  planar_walk(state, measured_slab(), kPlatePhotons);
}
void prism_planar(benchmark::State& state) {
  static MeasuredScene scene(prism_scene("next_event"));
  planar_walk(state, scene, kFilmPhotons);
}
void prism_planar_counting(benchmark::State& state) {
  static MeasuredScene scene(prism_scene("counting"));
  planar_walk(state, scene, kFilmPhotons);
}
void film_planar(benchmark::State& state) {
  planar_walk(state, measured_films(), kFilmPhotons);
}
void film_planar_counting(benchmark::State& state) {
  static MeasuredScene scene(film_scene("counting"));
  planar_walk(state, scene, kFilmPhotons);
}
void bare_slab_planar(benchmark::State& state) {
  static MeasuredScene scene(bare_slab_scene());
  planar_walk(state, scene, kPlatePhotons);
}

void slab_planar_polarization(benchmark::State& state) {
  PlanarWalker polarized(measured_slab().bench);
  NaturalPlanarWalker natural(measured_slab().bench);
  for (auto _ : state) {
    polarized.slice(kPlatePhotons);
    natural.slice(kPlatePhotons);
  }
  state.counters["polarized_per_unpolarized"] = polarized.seconds_per_event() / natural.seconds_per_event();
}

void prism_planar_polarization(benchmark::State& state) {
  static const BenchScene scene = prism_scene("counting");
  PlanarWalker polarized(scene);
  NaturalPlanarWalker natural(scene);
  for (auto _ : state) {
    polarized.slice(1000);
    natural.slice(1000);
  }
  state.counters["polarized_per_unpolarized"] = polarized.seconds_per_event() / natural.seconds_per_event();
}

BENCHMARK(slab_planar)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(prism_planar)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(prism_planar_counting)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_planar)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_planar_counting)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(bare_slab_planar)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(slab_planar_polarization)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(prism_planar_polarization)->Repetitions(7)->Unit(benchmark::kMillisecond);

/// How the cost of a photon grows: one thing of S1 or S2 changed at a time; microseconds by both paths.
void growth(benchmark::State& state, const SceneOptions& options) {
  const BenchScene scene = scene_with(options);
  PlanarWalker planar(scene);
  GeneralWalker general(scene);
  for (auto _ : state) {
    planar.slice(2000);
    general.slice();
  }
  state.counters["planar_us"] = 1e6 * planar.seconds_per_photon();
  state.counters["general_us"] = 1e6 * general.seconds_per_photon();
  state.counters["events"] = planar.events_per_photon();
}

#define EVENGLOW_GROWTH(name, ...)     \
  void name(benchmark::State& state) { \
    growth(state, __VA_ARGS__);        \
  }                                    \
  BENCHMARK(name)->Repetitions(5)->MinTime(0.1)->Unit(benchmark::kMillisecond)

EVENGLOW_GROWTH(growth_base, {});
EVENGLOW_GROWTH(growth_cells_1, {.nx = 1, .ny = 1});
EVENGLOW_GROWTH(growth_cells_1e6, {.nx = 1250, .ny = 800});
EVENGLOW_GROWTH(growth_thickness_1, {.thickness = 1.0});
EVENGLOW_GROWTH(growth_thickness_03, {.thickness = 0.3});
EVENGLOW_GROWTH(growth_density_tenth, {.density = 0.1});
EVENGLOW_GROWTH(growth_density_double, {.density = 2.0});
EVENGLOW_GROWTH(growth_films_1, {.films = 1});
EVENGLOW_GROWTH(growth_films_2, {.films = 2});
EVENGLOW_GROWTH(growth_films_4, {.films = 4});

}  // namespace
}  // namespace evenglow::bench

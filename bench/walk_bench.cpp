#include "bench/unpolarized_face.h"
#include "bench/walker.h"
#include "bench/yardstick.h"
#include <benchmark/benchmark.h>

namespace evenglow::bench {
namespace {

void walk(benchmark::State& state, MeasuredScene& scene) {
  GeneralWalker walker(scene.bench);
  scene.yardstick.reset();
  for (auto _ : state) {
    walker.slice();
    scene.yardstick.measure();
  }
  state.counters["R_ns"] = 1e9 * scene.yardstick.seconds();
  state.counters["event_ns"] = 1e9 * walker.seconds_per_event();
  state.counters["event_per_R"] = walker.seconds_per_event() / scene.yardstick.seconds();
  state.counters["photons_per_s"] = 1.0 / walker.seconds_per_photon();
  state.counters["events_per_photon"] = walker.events_per_photon();
}

/// `scene` against the same with faces that know no polarization.
void polarization(benchmark::State& state, const BenchScene& scene, BenchScene without) {
  forget_polarization(without);
  GeneralWalker polarized(scene);
  GeneralWalker unpolarized(without);
  for (auto _ : state) {
    polarized.slice();
    unpolarized.slice();
  }
  state.counters["polarized_per_unpolarized"] = polarized.seconds_per_event() / unpolarized.seconds_per_event();
}

void slab_walk(benchmark::State& state) {
  walk(state, measured_slab());
}
void film_walk(benchmark::State& state) {
  walk(state, measured_films());
}
void film_walk_counting(benchmark::State& state) {
  static MeasuredScene scene(film_scene("counting"));
  walk(state, scene);
}
void slab_polarization(benchmark::State& state) {
  polarization(state, measured_slab().bench, slab_scene());
}
void film_polarization(benchmark::State& state) {
  polarization(state, measured_films().bench, film_scene());
}

BENCHMARK(slab_walk)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_walk)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_walk_counting)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(slab_polarization)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_polarization)->Repetitions(7)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace evenglow::bench

#include "bench/walker.h"
#include "bench/wavefront_walker.h"
#include "bench/yardstick.h"
#include <benchmark/benchmark.h>

namespace evenglow::bench {
namespace {

/// The wavefront, slice by slice with the scalar planar path, the general path and the yardstick.
void wavefront_walk(benchmark::State& state, MeasuredScene& scene) {
  WavefrontWalker wavefront(scene.bench);
  PlanarWalker planar(scene.bench);
  GeneralWalker general(scene.bench);
  scene.yardstick.reset();
  for (auto _ : state) {
    wavefront.slice(10'000);
    planar.slice(2000);
    general.slice();
    scene.yardstick.measure();
  }
  state.counters["event_ns"] = 1e9 * wavefront.seconds_per_event();
  state.counters["event_per_R"] = wavefront.seconds_per_event() / scene.yardstick.seconds();
  state.counters["photons_per_s"] = 1.0 / wavefront.seconds_per_photon();
  state.counters["gain_planar"] = planar.seconds_per_photon() / wavefront.seconds_per_photon();
  state.counters["gain"] = general.seconds_per_photon() / wavefront.seconds_per_photon();
}

void slab_wavefront(benchmark::State& state) {
  wavefront_walk(state, measured_slab());
}
void bare_slab_wavefront(benchmark::State& state) {
  static MeasuredScene scene(bare_slab_scene());
  wavefront_walk(state, scene);
}
void film_wavefront(benchmark::State& state) {
  static MeasuredScene scene(film_scene("counting"));
  wavefront_walk(state, scene);
}
void prism_wavefront(benchmark::State& state) {
  static MeasuredScene scene(prism_scene("counting"));
  wavefront_walk(state, scene);
}

/// S1 by each instruction set: photons per second over those of the scalar planar path.
void slab_wavefront_by_set(benchmark::State& state) {
  for (const std::int64_t set : tracer::instruction_sets()) {
    tracer::force_instruction_set(set);
    WavefrontWalker wavefront(measured_slab().bench);
    PlanarWalker planar(measured_slab().bench);
    for (int i = 0; i < 10; ++i) {
      wavefront.slice(10'000);
      planar.slice(5000);
    }
    state.counters[tracer::instruction_set_name(set)] = planar.seconds_per_photon() / wavefront.seconds_per_photon();
  }
  tracer::force_instruction_set(0);
  for (auto _ : state) benchmark::DoNotOptimize(state.iterations());
}

BENCHMARK(slab_wavefront)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(bare_slab_wavefront)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(film_wavefront)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(prism_wavefront)->Repetitions(5)->Unit(benchmark::kMillisecond);
BENCHMARK(slab_wavefront_by_set)->Iterations(1)->Repetitions(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace evenglow::bench

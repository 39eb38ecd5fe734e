#include <cmath>
#include <memory>
#include <vector>

#include "bench/cpu_time.h"
#include "bench/yardstick.h"
#include <benchmark/benchmark.h>

#include "core/math/sampling.h"
#include "tracer/optics/dielectric_face.h"
#include "tracer/optics/opaque_reflector.h"

namespace evenglow::bench {
namespace {

using core::StokesVector;

/// A slice is long beside the time that filling the caches with a film's tables takes after one of the yardstick: in a
/// run they stay there.
constexpr std::size_t kPasses = 64;

/// Lambertian light from below, each ray partly polarized in a way of its own.
std::vector<StokesVector> incident_lights(std::size_t count) {
  core::PhotonRng rng({7, 0, 0}, 0);
  std::vector<StokesVector> lights;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = rng.uniform();
    const auto frame = core::PolarizationFrame::any(core::sample_lambertian(u, rng.uniform()));
    StokesVector light = StokesVector::linear(1.0, 2.0 * core::kPi * rng.uniform(), frame);
    const double degree = rng.uniform();
    light.Q *= degree;
    light.U *= degree;
    light.V = 0.5 * (1.0 - degree);
    lights.push_back(light);
  }
  return lights;
}

void sample(benchmark::State& state, const tracer::Bsdf& surface) {
  const auto lights = incident_lights(4096);
  core::PhotonRng rng({1, 0, 0}, 0);
  Yardstick& yardstick = measured_films().yardstick;
  yardstick.reset();
  double seconds = 0.0;
  double samples = 0.0;
  for (auto _ : state) {
    seconds += cpu_seconds_of([&] {
      for (std::size_t pass = 0; pass < kPasses; ++pass) {
        for (const StokesVector& light : lights) benchmark::DoNotOptimize(surface.sample(light, rng));
      }
    });
    samples += static_cast<double>(kPasses * lights.size());
    yardstick.measure();
  }
  state.counters["sample_ns"] = 1e9 * seconds / samples;
  state.counters["sample_per_R"] = seconds / samples / yardstick.seconds();
}

const tracer::BacklightSpec& samples() {
  static const tracer::BacklightSpec spec = film_samples();
  return spec;
}

void sample_smooth_face(benchmark::State& state) {
  sample(state, tracer::DielectricFace(1.4938, 1.0));
}
void sample_white_sheet(benchmark::State& state) {
  sample(state, tracer::OpaqueReflector(0.98, 0.0));
}
void sample_mirror(benchmark::State& state) {
  sample(state, tracer::OpaqueReflector(0.98, 1.0));
}
void sample_diffuser(benchmark::State& state) {
  sample(state, *samples().films[0].surface);
}
void sample_tabulated_dbef(benchmark::State& state) {
  sample(state, *samples().films[1].surface);
}
void sample_ideal_dbef(benchmark::State& state) {
  sample(state, *samples().films[2].surface);
}
void sample_lpp(benchmark::State& state) {
  sample(state, *samples().films[3].surface);
}

BENCHMARK(sample_smooth_face)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_white_sheet)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_mirror)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_diffuser)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_tabulated_dbef)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_ideal_dbef)->Repetitions(5)->MinTime(0.2);
BENCHMARK(sample_lpp)->Repetitions(5)->MinTime(0.2);

}  // namespace
}  // namespace evenglow::bench

#include <cmath>

#include "bench/bench_scene.h"
#include <benchmark/benchmark.h>

#include "core/montecarlo/batches.h"
#include "tracer/transport/tracer.h"

namespace evenglow::bench {
namespace {

struct TimedTrace {
  tracer::TraceResult result;
  double cpu_seconds = 0.0;  ///< all threads
};

TimedTrace timed_trace(const BenchScene& bench, std::uint64_t photons, std::uint64_t seed, int threads) {
  const double begin = core::process_cpu_seconds();
  auto result = tracer::trace(bench.scene, bench.density,
                              {.photons = photons, .batches = 100, .key = {seed, 0, 0}, .threads = threads});
  return {std::move(*result), core::process_cpu_seconds() - begin};
}

/// Sum over the cells of the squared standard errors.
double variance_of(const core::Tally& tally) {
  double sum = 0.0;
  for (const core::Estimate& cell : tally.totals()) sum += cell.se * cell.se;
  return sum;
}

/// Difference of the whole display's luminance in standard errors.
double difference_in_errors(const core::Tally& a, const core::Tally& b) {
  const std::vector<double> ones(a.bins(), 1.0);
  const core::Estimate x = a.weighted_total(ones);
  const core::Estimate y = b.weighted_total(ones);
  return (x.value - y.value) / std::hypot(x.se, y.se);
}

/// Figure of merit 1 / (variance x CPU time) per cell, next-event estimate over counting in the 10 degree cone.
void compare_estimators(benchmark::State& state, const BenchScene& counting, const BenchScene& next_event) {
  constexpr std::uint64_t kPhotons = 100'000;
  std::uint64_t seed = static_cast<std::uint64_t>(state.range(0));
  for (auto _ : state) {
    const TimedTrace by_count = timed_trace(counting, kPhotons, ++seed, 1);
    const TimedTrace by_event = timed_trace(next_event, kPhotons, ++seed, 1);
    state.counters["gain"] = variance_of(by_count.result.luminance) * by_count.cpu_seconds /
                             (variance_of(by_event.result.luminance) * by_event.cpu_seconds);
    state.counters["difference_se"] = difference_in_errors(by_count.result.luminance, by_event.result.luminance);
  }
}

void luminance_estimators(benchmark::State& state) {
  static const BenchScene counting = film_scene("counting");
  static const BenchScene next_event = film_scene("next_event");
  compare_estimators(state, counting, next_event);
}

void luminance_estimators_slab(benchmark::State& state) {
  static const BenchScene counting = slab_scene("counting");
  static const BenchScene next_event = slab_scene("next_event");
  compare_estimators(state, counting, next_event);
}

void luminance_estimators_prisms(benchmark::State& state) {
  static const BenchScene counting = prism_scene("counting");
  static const BenchScene next_event = prism_scene("next_event");
  compare_estimators(state, counting, next_event);
}

void luminance_estimators_ideal(benchmark::State& state) {
  static const BenchScene counting = ideal_film_scene("counting");
  static const BenchScene next_event = ideal_film_scene("next_event");
  compare_estimators(state, counting, next_event);
}

/// CPU time per photon on all threads over that on one.
void threads(benchmark::State& state) {
  static const BenchScene bench = slab_scene();
  constexpr std::uint64_t kPhotons = 100'000;
  const int all = core::effective_threads(0);
  for (auto _ : state) {
    const double one = timed_trace(bench, kPhotons, 1, 1).cpu_seconds;
    double most = one;
    for (int count = 2; count < 2 * all; count *= 2) {
      const int used = std::min(count, all);
      most = timed_trace(bench, kPhotons, 1, used).cpu_seconds;
      state.counters["cpu_ratio_" + std::to_string(used)] = most / one;
    }
    state.counters["cpu_ratio_all"] = most / one;
    state.counters["cpu_us_per_photon_1"] = 1e6 * one / static_cast<double>(kPhotons);
  }
}

/// Five seeds take the place of repetitions, which would trace the same photons.
void five_seeds(benchmark::internal::Benchmark* bench) {
  for (int seed = 10; seed <= 50; seed += 10) bench->Arg(seed);
  bench->Iterations(1)->Unit(benchmark::kSecond);
}

BENCHMARK(luminance_estimators)->Apply(five_seeds);
BENCHMARK(luminance_estimators_slab)->Apply(five_seeds);
BENCHMARK(luminance_estimators_prisms)->Apply(five_seeds);
BENCHMARK(luminance_estimators_ideal)->Apply(five_seeds);
BENCHMARK(threads)->Iterations(1)->Repetitions(5)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace evenglow::bench

#include "bench/yardstick.h"

#include "bench/cpu_time.h"
#include <benchmark/benchmark.h>

namespace evenglow::bench {
namespace {

constexpr std::size_t kSegments = 1'000'000;
constexpr std::size_t kSlice = 100'000;

}  // namespace

Yardstick::Yardstick(const BenchScene& bench)
    : segments_(record_segments(bench, kSegments)), tree_(bench.scene.caster->quads()) {}

void Yardstick::measure() {
  seconds_ += cpu_seconds_of([&] { benchmark::DoNotOptimize(tree_.replay(segments_, next_, kSlice)); });
  next_ += kSlice;
  rays_ += kSlice;
}

void Yardstick::reset() {
  rays_ = 0;
  seconds_ = 0.0;
}

MeasuredScene& measured_slab() {
  static MeasuredScene scene(slab_scene());
  return scene;
}

MeasuredScene& measured_films() {
  static MeasuredScene scene(film_scene());
  return scene;
}

}  // namespace evenglow::bench

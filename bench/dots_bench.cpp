#include <cmath>
#include <memory>

#include "bench/cpu_time.h"
#include "bench/walker.h"
#include "bench/yardstick.h"
#include <benchmark/benchmark.h>

#include "core/dots/dot.h"
#include "tracer/microstructure/dot_grid.h"

namespace evenglow::bench {
namespace {

constexpr std::uint64_t kPhotons = 8000;
constexpr int kColumns = 1250, kRows = 800;  // 1e6 dots

/// S1 with the dots themselves: one in each cell of a fine lattice, anywhere where it stays within, as large as the
/// density asks for.
BenchScene dotted_slab() {
  BenchScene bench = slab_scene();
  const tracer::Box& face = bench.scene.spec.area;
  const double dx = (face.max.x() - face.min.x()) / kColumns, dy = (face.max.y() - face.min.y()) / kRows;
  core::PhotonRng rng({1, 2, 3}, 0);
  core::DotPattern dots;
  for (int iy = 0; iy < kRows; ++iy) {
    for (int ix = 0; ix < kColumns; ++ix) {
      const double x = face.min.x() + (ix + 0.5) * dx, y = face.min.y() + (iy + 0.5) * dy;
      const double radius = std::sqrt(bench.density.cells.at(x, y) * dx * dy / 3.14159265358979);
      const double room_x = std::max(0.0, dx - 2.0 * radius), room_y = std::max(0.0, dy - 2.0 * radius);
      const double along = rng.uniform() - 0.5;
      dots.push_back({x + along * room_x, y + (rng.uniform() - 0.5) * room_y, static_cast<float>(radius)});
    }
  }
  bench.density.dots = std::make_shared<const tracer::DotGrid>(
      dots, core::Footprint::round, tracer::FaceArea{face.min.x(), face.max.x(), face.min.y(), face.max.y()});
  return bench;
}

MeasuredScene& measured_dots() {
  static MeasuredScene measured(dotted_slab());
  return measured;
}

using DotWalker = Walker<Planar<tracer::DotPlanarHistory>>;

/// Both paths among the dots, and the planar one in their density, slice by slice with the yardstick.
void slab_dots(benchmark::State& state) {
  MeasuredScene& scene = measured_dots();
  DotWalker planar(scene.bench);
  GeneralWalker general(scene.bench);
  PlanarWalker density(measured_slab().bench);
  scene.yardstick.reset();
  for (auto _ : state) {
    planar.slice(kPhotons);
    general.slice();
    density.slice(kPhotons);
    scene.yardstick.measure();
  }
  const double R = scene.yardstick.seconds();
  state.counters["planar_event_per_R"] = planar.seconds_per_event() / R;
  state.counters["general_event_per_R"] = general.seconds_per_event() / R;
  state.counters["over_density"] = planar.seconds_per_event() / density.seconds_per_event();
  state.counters["photons_per_s"] = 1.0 / planar.seconds_per_photon();
  const tracer::DotGrid& dots = *scene.bench.density.dots;
  state.counters["bytes_per_dot"] = static_cast<double>(dots.bytes()) / static_cast<double>(dots.size());
}

/// A place anywhere on the face: each look-up finds its dots in memory that no cache holds.
void dot_lookup(benchmark::State& state) {
  MeasuredScene& scene = measured_dots();
  const tracer::DotGrid& dots = *scene.bench.density.dots;
  core::PhotonRng rng({4, 5, 6}, 0);
  scene.yardstick.reset();
  constexpr int kLookups = 100000;
  double seconds = 0.0, lookups = 0.0;
  for (auto _ : state) {
    seconds += cpu_seconds_of([&] {
      int hits = 0;
      for (int i = 0; i < kLookups; ++i) {
        const double x = 100.0 * rng.uniform();
        hits += dots.covers(x, 60.0 * rng.uniform()) ? 1 : 0;
      }
      benchmark::DoNotOptimize(hits);
    });
    lookups += kLookups;
    scene.yardstick.measure();
  }
  state.counters["lookup_ns"] = 1e9 * seconds / lookups;
  state.counters["lookup_per_R"] = seconds / lookups / scene.yardstick.seconds();
}

BENCHMARK(slab_dots)->Repetitions(7)->Unit(benchmark::kMillisecond);
BENCHMARK(dot_lookup)->Repetitions(7)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace evenglow::bench

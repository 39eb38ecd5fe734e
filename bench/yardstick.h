#pragma once

#include <utility>

#include "bench/raw_tree.h"

namespace evenglow::bench {

/// A scene with its yardstick: measures R in slices between the slices of what is held against it, so that both see the
/// same clock rate and the same neighbors on the machine.
class Yardstick {
 public:
  explicit Yardstick(const BenchScene& bench);

  /// Times one slice of raw intersections.
  void measure();
  void reset();
  /// Seconds of one raw intersection, since the last reset.
  double seconds() const { return seconds_ / static_cast<double>(rays_); }

 private:
  std::vector<Segment> segments_;
  RawTree tree_;
  std::size_t next_ = 0;
  std::size_t rays_ = 0;
  double seconds_ = 0.0;
};

/// S1 and S2 with their yardsticks, made at the first use.
struct MeasuredScene {
  explicit MeasuredScene(BenchScene scene) : bench(std::move(scene)), yardstick(bench) {}
  BenchScene bench;
  Yardstick yardstick;
};
MeasuredScene& measured_slab();
MeasuredScene& measured_films();

}  // namespace evenglow::bench

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "bench/bench_scene.h"

namespace evenglow::bench {

/// One flight of a walk: where it starts, in single precision as the tree takes it.
struct Segment {
  float origin[3];
  float direction[3];
};

/// The first `count` flights of the walks of photons 0, 1, 2, ...
std::vector<Segment> record_segments(const BenchScene& bench, std::size_t count);

/// The yardstick R: a plain `rtcIntersect1` on quads with the flags of tracer/geometry/ray_caster.cpp, without its
/// filter and without the second, double-precision location of the hit.
class RawTree {
 public:
  explicit RawTree(const std::vector<tracer::Quad>& quads);
  ~RawTree();
  RawTree(const RawTree&) = delete;
  RawTree& operator=(const RawTree&) = delete;

  /// Replays segments [first, first + count), cyclic; returns how many met a quad.
  std::size_t replay(const std::vector<Segment>& segments, std::size_t first, std::size_t count) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace evenglow::bench

#pragma once

#include <array>
#include <cstddef>

#include "core/math/vec3.h"
#include "tracer/microstructure/ray_span.h"

namespace evenglow::tracer {

/// Convex body over z = 0 with N flat facets: normal . p <= offset. Face 0 is the footprint, facet i is face i + 1.
template <std::size_t N>
struct FlatFacets {
  std::array<core::Vec3, N> normals;  ///< unit, outward
  std::array<double, N> offsets;

  RaySpan span(const core::Vec3& p, const core::Vec3& k) const {
    RaySpan span;
    span.cut(p.z(), -k.z(), RaySpan::kFootprint);
    for (std::size_t i = 0; i < N; ++i) {
      span.cut(offsets[i] - normals[i].dot(p), normals[i].dot(k), static_cast<int>(i) + 1);
    }
    return span;
  }
  core::Vec3 normal(int face) const {
    return face == RaySpan::kFootprint ? core::Vec3(-core::Vec3::UnitZ()) : normals[static_cast<std::size_t>(face) - 1];
  }
};

}  // namespace evenglow::tracer

#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/math/vec3.h"
#include "tracer/geometry/mesh.h"

/// The one door to Embree 3.
namespace evenglow::tracer {

struct RayHit {
  int quad = -1;          ///< index in the mesh, -1: nothing was met
  double distance = 0.0;  ///< mm
  core::Vec3 position;    ///< on the quad to double rounding, never outside its rectangle
};

/// Nearest hit of a ray. The search runs in Embree's single-precision tree (ROBUST, quads, which do not leak along
/// shared edges); distance and position are then computed anew in double on the quad that was found.
class RayCaster {
 public:
  explicit RayCaster(std::vector<Quad> quads);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// Nearest quad along the ray, other than `skip` (-1: none): a ray that leaves a flat quad cannot meet it again.
  RayHit nearest(const core::Vec3& origin, const core::Vec3& direction, int skip) const;

  /// Where a ray that starts in a convex body leaves it: the face of least distance among those that it runs against.
  /// `faces`: all quads of the body, their normals pointing out, few enough to be tried in turn; `skip` as above. In
  /// double precision, without the tree: about a quarter of its time for a box, and nothing can leak.
  RayHit exit_of(std::span<const int> faces, const core::Vec3& origin, const core::Vec3& direction, int skip) const;

  /// The nearest of the quads that `allowed` admits, by a search through all in double precision: slow, for the few
  /// rays that single precision decides wrongly at an edge. Hits down to 1e-7 mm behind the origin, and beyond a border
  /// by 1e-7 of the quad's size, count.
  RayHit nearest_exact(const core::Vec3& origin, const core::Vec3& direction,
                       const std::function<bool(int quad)>& allowed) const;

  const std::vector<Quad>& quads() const { return quads_; }

 private:
  struct Tree;
  struct Plane {
    core::Vec3 normal;
    double offset;              ///< normal . p
    core::Vec3 dual_u, dual_v;  ///< a = dual_u . (p - corner), b = dual_v . (p - corner)
  };
  double distance_to(int quad, const core::Vec3& origin, const core::Vec3& direction) const;
  /// The hit at this distance, moved into the quad's rectangle.
  RayHit located(int quad, double distance, const core::Vec3& origin, const core::Vec3& direction) const;

  std::vector<Quad> quads_;
  std::vector<Plane> planes_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace evenglow::tracer

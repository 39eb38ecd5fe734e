#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/montecarlo/photon_rng.h"
#include "tests/support/field_ray.h"

/// An independent trace of microstructures: an explicit triangle mesh of one cell of a pattern in Embree, and light as
/// a complex field vector. Shares no code with tracer/microstructure.
namespace evenglow::tests {

/// One cell of a pattern on a face, z out of the plate; lengths in units of half the footprint's width.
struct BumpPattern {
  enum class Shape { kCap, kCone, kPyramid, kGroove };
  Shape shape = Shape::kPyramid;
  bool sunk = false;
  double flank = 0.7;       ///< rad: of cone and pyramid; of the groove's flank on the side of -x
  double right = 0.7;       ///< rad: of the groove's flank on the side of +x
  double truncation = 0.0;  ///< of cone and pyramid
  double aspect = 0.2;      ///< of the cap
  double index = 1.5;       ///< of the plate
  double turn = 0.0;        ///< rad: of the cell's x axis from that of the face
  /// Half the width of the square cell, >= 1. 0: footprints without room between them: the cell is the footprint, and a
  /// round one is left and entered again at the two ends of a chord.
  double cell = 0.0;
};

class BumpMesh {
 public:
  explicit BumpMesh(const BumpPattern& pattern);
  ~BumpMesh();

  /// Follows light that comes to a uniform point of the cell until it leaves up or down; empty if it slipped through an
  /// edge of the mesh (single precision).
  std::optional<FieldRay> trace(FieldRay ray, core::PhotonRng& rng) const;

 private:
  enum class Face { kFlat, kCap, kCone };
  struct Tree;
  struct Hit {
    double distance;
    Eigen::Vector3d normal;
  };

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, Face face);
  void add_round();
  void add_pyramid();
  void add_groove();
  void add_square_frame();
  void build_tree();
  std::optional<Hit> nearest(const Eigen::Vector3d& p, const Eigen::Vector3d& k, double before) const;
  Eigen::Vector3d normal_at(std::size_t triangle, const Eigen::Vector3d& p) const;
  double way_to_wall(const Eigen::Vector3d& p, const Eigen::Vector3d& k) const;
  void enter_next(Eigen::Vector3d& p, const Eigen::Vector3d& k) const;
  Eigen::Vector3d uniform_point(core::PhotonRng& rng) const;

  BumpPattern pattern_;
  double height_ = 0.0;
  double low_ = 0.0, high_ = 0.0;  ///< z of the deepest and the highest point
  std::vector<Eigen::Vector3d> corners_;
  std::vector<Face> faces_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace evenglow::tests

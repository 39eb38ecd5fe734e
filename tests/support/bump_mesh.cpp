#include "tests/support/bump_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>

#include "core/base/error.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using Complex = std::complex<double>;

constexpr double kNear = 3e-5;  // single precision sees a ray's own triangle up to here

}  // namespace

struct BumpMesh::Tree {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  ~Tree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

BumpMesh::BumpMesh(const BumpPattern& pattern) : pattern_(pattern), tree_(std::make_unique<Tree>()) {
  switch (pattern_.shape) {
    case BumpPattern::Shape::kCap:
      height_ = 2.0 * pattern_.aspect;
      add_round();
      break;
    case BumpPattern::Shape::kCone:
      height_ = std::tan(pattern_.flank) * (1.0 - pattern_.truncation);
      add_round();
      break;
    case BumpPattern::Shape::kPyramid:
      height_ = std::tan(pattern_.flank) * (1.0 - pattern_.truncation);
      add_pyramid();
      break;
    case BumpPattern::Shape::kGroove:
      add_groove();
      break;
  }
  low_ = pattern_.sunk ? -height_ : 0.0;
  high_ = pattern_.sunk ? 0.0 : height_;
  build_tree();
}

BumpMesh::~BumpMesh() = default;

void BumpMesh::build_tree() {
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), corners_.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), faces_.size()));
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      vertices[3 * i + static_cast<std::size_t>(axis)] = static_cast<float>(corners_[i][axis]);
    indices[i] = static_cast<unsigned>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree_->scene);
  core::expects(rtcGetDeviceError(tree_->device) == RTC_ERROR_NONE, "Embree builds the mesh");
}

Vec3 BumpMesh::normal_at(std::size_t triangle, const Vec3& p) const {
  const double up = pattern_.sunk ? -1.0 : 1.0;
  const double around = std::hypot(p.x(), p.y());
  if (faces_[triangle] == Face::kCone && around > 0.0) {
    const double s = up * std::sin(pattern_.flank);
    return {s * p.x() / around, s * p.y() / around, std::cos(pattern_.flank)};
  }
  if (faces_[triangle] == Face::kCap) {
    // A sphere about (0, 0, -up depth); the normal points to the air.
    const double depth = (1.0 + height_ * height_) / (2.0 * height_) - height_;
    return up * Vec3(p.x(), p.y(), p.z() + up * depth).normalized();
  }
  const Vec3 n =
      (corners_[3 * triangle + 1] - corners_[3 * triangle]).cross(corners_[3 * triangle + 2] - corners_[3 * triangle]);
  return (n.z() > 0.0 ? n : Vec3(-n)).normalized();
}

std::optional<BumpMesh::Hit> BumpMesh::nearest(const Vec3& p, const Vec3& k, double before) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(p.x());
  query.ray.org_y = static_cast<float>(p.y());
  query.ray.org_z = static_cast<float>(p.z());
  query.ray.dir_x = static_cast<float>(k.x());
  query.ray.dir_y = static_cast<float>(k.y());
  query.ray.dir_z = static_cast<float>(k.z());
  query.ray.tnear = static_cast<float>(kNear);
  query.ray.tfar = static_cast<float>(std::min(before + 1e-6, 1e6));
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t triangle = query.hit.primID;
  const Vec3& a = corners_[3 * triangle];
  const Vec3 n = (corners_[3 * triangle + 1] - a).cross(corners_[3 * triangle + 2] - a);
  const double slope = n.dot(k);
  const double distance = std::abs(slope) > 1e-12 ? n.dot(a - p) / slope : static_cast<double>(query.ray.tfar);
  return Hit{distance, normal_at(triangle, p + distance * k)};
}

double BumpMesh::way_to_wall(const Vec3& p, const Vec3& k) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool round = pattern_.shape == BumpPattern::Shape::kCap || pattern_.shape == BumpPattern::Shape::kCone;
  if (round && pattern_.cell <= 0.0) {
    const double a = k.x() * k.x() + k.y() * k.y();
    const double b = p.x() * k.x() + p.y() * k.y();
    const double c = p.x() * p.x() + p.y() * p.y() - 1.0;
    return a > 0.0 ? (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a : kFar;
  }
  const double half = std::max(1.0, pattern_.cell);
  double way = kFar;
  for (int axis = 0; axis < 2; ++axis) {
    if (k[axis] != 0.0) way = std::min(way, (std::copysign(half, k[axis]) - p[axis]) / k[axis]);
  }
  return std::max(0.0, way);
}

void BumpMesh::enter_next(Vec3& p, const Vec3& k) const {
  const bool round = pattern_.shape == BumpPattern::Shape::kCap || pattern_.shape == BumpPattern::Shape::kCone;
  if (round && pattern_.cell <= 0.0) {  // p is on the circle: back along the chord
    const Vec3 u = Vec3(k.x(), k.y(), 0.0).normalized();
    p -= 2.0 * (p.x() * u.x() + p.y() * u.y()) * u;
    return;
  }
  const double half = std::max(1.0, pattern_.cell);
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(std::copysign(half, k[axis]) - p[axis]) < 1e-9) p[axis] = -std::copysign(half, k[axis]);
  }
}

Vec3 BumpMesh::uniform_point(core::PhotonRng& rng) const {
  const bool round = pattern_.shape == BumpPattern::Shape::kCap || pattern_.shape == BumpPattern::Shape::kCone;
  const double half = std::max(1.0, pattern_.cell);
  for (;;) {
    const double x = half * (2.0 * rng.uniform() - 1.0);
    const double y = half * (2.0 * rng.uniform() - 1.0);
    if (!round || pattern_.cell > 0.0 || x * x + y * y < 1.0) return {x, y, 0.0};
  }
}

std::optional<FieldRay> BumpMesh::trace(FieldRay ray, core::PhotonRng& rng) const {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(pattern_.turn, Vec3::UnitZ()).toRotationMatrix();
  ray = {turn.transpose() * ray.k, turn.transpose().cast<Complex>() * ray.field};
  bool inside = ray.k.z() > 0.0;
  Vec3 p = uniform_point(rng);
  p.z() = inside ? low_ - 2.0 * kNear : high_ + 2.0 * kNear;
  for (int events = 0; events < 20000; ++events) {
    const double wall = way_to_wall(p, ray.k);
    if (const auto hit = nearest(p, ray.k, wall)) {
      p += std::max(0.0, hit->distance) * ray.k;
      meet_facet(ray, hit->normal, pattern_.index, 1.0, inside, rng);
      continue;
    }
    const double gone = p.z() + wall * ray.k.z();
    const bool out = ray.k.z() > 0.0 ? gone > high_ : gone < low_;
    if (out) {
      if (inside == (ray.k.z() > 0.0)) return std::nullopt;
      return FieldRay{turn * ray.k, turn.cast<Complex>() * ray.field};
    }
    p += wall * ray.k;
    enter_next(p, ray.k);
  }
  return std::nullopt;
}

}  // namespace evenglow::tests

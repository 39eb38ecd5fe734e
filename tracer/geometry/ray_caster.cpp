#include "tracer/geometry/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <embree3/rtcore.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

/// What still counts as a hit of `nearest_exact`: mm behind the origin, share of a quad's size beyond its border.
constexpr double kSlack = 1e-7;

/// The context of one query: Embree hands it back to the filter.
struct SkipContext {
  RTCIntersectContext context;
  unsigned skip;
};

/// Refuses the quad that the ray leaves. Its own plane lies at distance zero in exact single-precision arithmetic, so
/// tnear can stay at zero and a neighbor that is met at once, in a corner, is not missed.
void skip_filter(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const SkipContext*>(arguments->context);
  if (RTCHitN_primID(arguments->hit, arguments->N, 0) == context->skip) arguments->valid[0] = 0;
}

void raise(void*, RTCError code, const char* text) {
  throw core::Error("Embree error " + std::to_string(static_cast<int>(code)) + ": " + (text != nullptr ? text : ""));
}

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter>;
using ScenePointer = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter>;

void store(float* out, const core::Vec3& p) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(p[i]);
}

}  // namespace

struct RayCaster::Tree {
  DevicePointer device;
  ScenePointer scene;
};

RayCaster::RayCaster(std::vector<Quad> quads) : quads_(std::move(quads)), tree_(std::make_unique<Tree>()) {
  for (const Quad& quad : quads_) {
    const core::Vec3 n = quad.u.cross(quad.v);
    core::expects(n.norm() > 0.0, "a quad has an area");
    const core::Vec3 normal = n.normalized();
    planes_.push_back(
        {normal, normal.dot(quad.corner), quad.v.cross(n) / n.squaredNorm(), n.cross(quad.u) / n.squaredNorm()});
  }
  tree_->device.reset(rtcNewDevice(nullptr));
  core::expects(tree_->device != nullptr, "Embree opens a device");
  rtcSetDeviceErrorFunction(tree_->device.get(), raise, nullptr);
  tree_->scene.reset(rtcNewScene(tree_->device.get()));
  rtcSetSceneFlags(tree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  if (!quads_.empty()) {
    RTCGeometry geometry = rtcNewGeometry(tree_->device.get(), RTC_GEOMETRY_TYPE_QUAD);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), 4 * quads_.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                                   4 * sizeof(unsigned), quads_.size()));
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const Quad& q = quads_[i];
      store(vertices + 12 * i, q.corner);
      store(vertices + 12 * i + 3, q.corner + q.u);
      store(vertices + 12 * i + 6, q.corner + q.u + q.v);
      store(vertices + 12 * i + 9, q.corner + q.v);
      for (unsigned k = 0; k < 4; ++k) indices[4 * i + k] = static_cast<unsigned>(4 * i) + k;
    }
    rtcSetGeometryIntersectFilterFunction(geometry, skip_filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(tree_->scene.get());
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

RayHit RayCaster::nearest(const core::Vec3& origin, const core::Vec3& direction, int skip) const {
  SkipContext context;
  rtcInitIntersectContext(&context.context);
  context.skip = static_cast<unsigned>(skip);
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(origin.x());
  query.ray.org_y = static_cast<float>(origin.y());
  query.ray.org_z = static_cast<float>(origin.z());
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tnear = 0.0F;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.time = 0.0F;
  query.ray.mask = ~0U;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree_->scene.get(), &context.context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const int quad = static_cast<int>(query.hit.primID);
  const double distance = distance_to(quad, origin, direction);
  // In single precision the origin may lie on a quad, or beyond it, that the ray has behind it: in a corner of two
  // mirrors the photon would be thrown to and fro for ever.
  if (distance < -kSlack) return nearest_exact(origin, direction, [skip](int other) { return other != skip; });
  return located(quad, distance, origin, direction);
}

RayHit RayCaster::exit_of(std::span<const int> faces, const core::Vec3& origin, const core::Vec3& direction,
                          int skip) const {
  int nearest_face = -1;
  double nearest_t = std::numeric_limits<double>::infinity();
  for (const int face : faces) {
    const Plane& plane = planes_[static_cast<std::size_t>(face)];
    const double slope = plane.normal.dot(direction);
    const double t = (plane.offset - plane.normal.dot(origin)) / slope;
    if (slope > 0.0 && t < nearest_t && face != skip) {
      nearest_t = t;
      nearest_face = face;
    }
  }
  if (nearest_face < 0) return {};
  return located(nearest_face, nearest_t, origin, direction);
}

double RayCaster::distance_to(int quad, const core::Vec3& origin, const core::Vec3& direction) const {
  const Plane& plane = planes_[static_cast<std::size_t>(quad)];
  const double slope = plane.normal.dot(direction);
  // Parallel rays meet a plane only through rounding of the tree; they stay where they are.
  return slope != 0.0 ? (plane.offset - plane.normal.dot(origin)) / slope : 0.0;
}

RayHit RayCaster::located(int quad, double distance, const core::Vec3& origin, const core::Vec3& direction) const {
  const Plane& plane = planes_[static_cast<std::size_t>(quad)];
  const Quad& q = quads_[static_cast<std::size_t>(quad)];
  const double t = std::max(0.0, distance);
  const core::Vec3 offset = origin + t * direction - q.corner;
  const double a = std::clamp(plane.dual_u.dot(offset), 0.0, 1.0);
  const double b = std::clamp(plane.dual_v.dot(offset), 0.0, 1.0);
  return {quad, t, q.corner + a * q.u + b * q.v};
}

RayHit RayCaster::nearest_exact(const core::Vec3& origin, const core::Vec3& direction,
                                const std::function<bool(int quad)>& allowed) const {
  RayHit best;
  double best_t = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(quads_.size()); ++i) {
    if (!allowed(i)) continue;
    const Plane& plane = planes_[static_cast<std::size_t>(i)];
    const Quad& q = quads_[static_cast<std::size_t>(i)];
    const double slope = plane.normal.dot(direction);
    if (slope == 0.0) continue;
    const double t = (plane.offset - plane.normal.dot(origin)) / slope;
    if (t < -kSlack || t >= best_t) continue;
    const core::Vec3 offset = origin + t * direction - q.corner;
    const double a = plane.dual_u.dot(offset);
    const double b = plane.dual_v.dot(offset);
    if (a < -kSlack || a > 1.0 + kSlack || b < -kSlack || b > 1.0 + kSlack) continue;
    best = located(i, t, origin, direction);
    best_t = t;
  }
  return best;
}

}  // namespace evenglow::tracer

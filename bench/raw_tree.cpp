#include "bench/raw_tree.h"

#include <limits>

#include <embree3/rtcore.h>

#include "tracer/transport/photon_history.h"

namespace evenglow::bench {
namespace {

/// Keeps the quad that a ray leaves, which it meets at distance zero, out of the search; of no account elsewhere (mm).
constexpr float kNearest = 1e-30F;

Segment segment_of(const tracer::Photon& photon) {
  const core::Vec3& o = photon.position;
  const core::Vec3& d = photon.light.frame.k;
  return {{static_cast<float>(o.x()), static_cast<float>(o.y()), static_cast<float>(o.z())},
          {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())}};
}

RTCRayHit query_of(const Segment& segment) {
  RTCRayHit query;
  query.ray.org_x = segment.origin[0];
  query.ray.org_y = segment.origin[1];
  query.ray.org_z = segment.origin[2];
  query.ray.dir_x = segment.direction[0];
  query.ray.dir_y = segment.direction[1];
  query.ray.dir_z = segment.direction[2];
  query.ray.tnear = kNearest;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.time = 0.0F;
  query.ray.mask = ~0U;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

std::vector<Segment> record_segments(const BenchScene& bench, std::size_t count) {
  const tracer::PhotonHistory history(bench.scene, bench.density);
  tracer::BatchSums sums(bench.scene);
  std::vector<Segment> segments;
  segments.reserve(count);
  for (std::uint64_t photon = 0; segments.size() < count; ++photon) {
    core::PhotonRng rng({}, photon);
    auto walk = history.start(rng);
    do {
      segments.push_back(segment_of(walk.photon));
    } while (history.step(walk, rng, sums) && segments.size() < count);
  }
  return segments;
}

struct RawTree::Handles {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
};

RawTree::RawTree(const std::vector<tracer::Quad>& quads) : handles_(std::make_unique<Handles>()) {
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_QUAD);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 4 * quads.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                                                 4 * sizeof(unsigned), quads.size()));
  for (const tracer::Quad& q : quads) {
    for (const core::Vec3& p :
         {q.corner, core::Vec3(q.corner + q.u), core::Vec3(q.corner + q.u + q.v), core::Vec3(q.corner + q.v)}) {
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(p[axis]);
    }
  }
  for (unsigned i = 0; i < 4 * quads.size(); ++i) indices[i] = i;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
}

RawTree::~RawTree() {
  rtcReleaseScene(handles_->scene);
  rtcReleaseDevice(handles_->device);
}

std::size_t RawTree::replay(const std::vector<Segment>& segments, std::size_t first, std::size_t count) const {
  std::size_t met = 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::size_t at = first % segments.size();
  for (std::size_t i = 0; i < count; ++i) {
    RTCRayHit query = query_of(segments[at]);
    if (++at == segments.size()) at = 0;
    rtcIntersect1(handles_->scene, &context, &query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) ++met;
  }
  return met;
}

}  // namespace evenglow::bench

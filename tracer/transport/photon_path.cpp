#include "tracer/transport/photon_path.h"

#include <array>
#include <cmath>

#include "tracer/transport/photon_history.h"

namespace evenglow::tracer {
namespace {

constexpr std::array<const char*, kLossReasons> kReasons = {"leaked", "stuck", "invalid"};

/// The bin of the account that the photon fell into, in words.
std::string fate_of(const Scene& scene, const std::vector<double>& energy) {
  for (int side = 0; side < kSides; ++side) {
    if (energy[static_cast<std::size_t>(side)] > 0.0)
      return std::string("leaves by ") + side_name(static_cast<Side>(side));
  }
  const auto& parts = scene.energy.parts();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (energy[scene.energy.absorbed_bin(static_cast<int>(part))] > 0.0) return "absorbed by " + parts[part];
  }
  for (int reason = 0; reason < kLossReasons; ++reason) {
    if (energy[scene.energy.lost_bin(static_cast<LossReason>(reason))] > 0.0)
      return std::string("lost: ") + kReasons[static_cast<std::size_t>(reason)];
  }
  return "carries no luminous flux";
}

std::string facing(const core::Vec3& normal) {
  for (int i = 0; i < kSides; ++i) {
    const auto side = static_cast<Side>(i);
    if (normal.dot(outward(side)) > 0.9) return side_name(side);
  }
  return "";
}

PathVertex vertex_of(const Scene& scene, const PhotonHistory::Walk& walk) {
  PathVertex vertex{walk.photon.position, walk.photon.light, "bulk", "", walk.photon.body};
  if (walk.photon.quad < 0) return vertex;
  const Surface& surface = scene.optics[walk.band].surfaces[static_cast<std::size_t>(walk.photon.quad)];
  vertex.at = scene.energy.parts()[static_cast<std::size_t>(surface.part)];
  vertex.side = facing(surface.normal);
  return vertex;
}

/// Where a photon that ended on its way was going: the next surface, or the border of the backlight.
core::Vec3 end_of(const Scene& scene, const Photon& photon) {
  const core::Vec3& k = photon.light.frame.k;
  const RayHit hit = scene.caster->nearest(photon.position, k, photon.quad);
  if (hit.quad >= 0) return hit.position;
  const Side side = scene.box.exit_side(photon.position, k);
  const double distance = (scene.box.plane(side) - photon.position[axis_of(side)]) / k[axis_of(side)];
  return photon.position + (std::isfinite(distance) ? std::max(distance, 0.0) : 0.0) * k;
}

}  // namespace

PhotonPath record_path(const Scene& scene, const DensityField& density, const core::RandomKey& key,
                       std::uint64_t photon_index, std::size_t most_vertices) {
  const PhotonHistory history(scene, density);
  BatchSums sums(scene);
  core::PhotonRng rng(key, photon_index);
  PhotonHistory::Walk walk = history.start(rng);
  PhotonPath path;
  path.band = walk.band;
  path.vertices.push_back(vertex_of(scene, walk));
  path.vertices.front().at = "source";
  for (;;) {
    ++path.events;
    if (!history.step(walk, rng, sums)) break;
    if (path.vertices.size() < most_vertices) path.vertices.push_back(vertex_of(scene, walk));
    if (path.events >= static_cast<std::size_t>(PhotonHistory::kMaxEvents)) {
      sums.energy[scene.energy.lost_bin(LossReason::kStuck)] += 1.0;
      break;
    }
  }
  path.end = end_of(scene, walk.photon);
  path.fate = fate_of(scene, sums.energy);
  return path;
}

}  // namespace evenglow::tracer

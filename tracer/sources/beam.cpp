#include "tracer/sources/beam.h"

#include <cmath>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

struct BeamKeys {
  Side face = Side::kBottom;
  double angle = 0.0;  // rad
  double plane = 0.0;  // rad
  std::string polarization;
  double azimuth = 0.0;  // rad
  double size_share = 0.2;
  double gap = 0.0;     // mm
  double flux = 100.0;  // lm
};

class Beam final : public Source {
 public:
  Beam(const BeamKeys& keys, const Box& box) : keys_(keys), axes_(side_axes(keys.face)) {
    center_ = 0.5 * (box.min + box.max);
    center_[axis_of(keys.face)] = box.plane(keys.face) + (is_upper(keys.face) ? keys.gap : -keys.gap);
    size_ = keys.size_share * (box.max - box.min);
    const core::Vec3 h = std::cos(keys.plane) * axes_.a + std::sin(keys.plane) * axes_.b;
    const core::Vec3 k = std::sin(keys.angle) * h + std::cos(keys.angle) * axes_.inward;
    // e1 in the plane of incidence, its tangential part along h.
    const core::PolarizationFrame frame{k, std::cos(keys.angle) * h - std::sin(keys.angle) * axes_.inward};
    if (keys.polarization == "linear") {
      // Counted from h towards inward x h, which is e2 here because k points inward.
      light_ = core::StokesVector::linear(1.0, keys.azimuth, frame);
    } else if (keys.polarization == "circular") {
      light_ = {1.0, 0.0, 0.0, 1.0, frame};
    } else {
      light_ = core::StokesVector::unpolarized(1.0, frame);
    }
  }

  double flux() const override { return keys_.flux; }
  Side side() const override { return keys_.face; }
  double gap() const override { return keys_.gap; }

  Photon emit(core::PhotonRng& rng) const override {
    Photon photon;
    photon.position = center_;
    photon.position += (rng.uniform() - 0.5) * size_.dot(axes_.a) * axes_.a;
    photon.position += (rng.uniform() - 0.5) * size_.dot(axes_.b) * axes_.b;
    photon.light = light_;
    return photon;
  }

 private:
  BeamKeys keys_;
  SideAxes axes_;
  core::Vec3 center_;
  core::Vec3 size_;
  core::StokesVector light_;
};

}  // namespace

SourceSpec make_beam(const core::ConfigNode& node) {
  using core::Range;
  BeamKeys keys;
  keys.face =
      read_side(node, {"face", "face that is lit", {"left", "right", "front", "back", "bottom", "top"}, "bottom"});
  keys.angle = node.number({"angle_deg", "angle of incidence", {0, 90, false, true}, 0.0});
  keys.plane = node.number({"plane_deg",
                            "azimuth of the plane of incidence, from x (from y for left and right)",
                            {0, 360, false, true},
                            0.0});
  keys.polarization =
      node.choice({"polarization", "state of polarization; circular is right", {"none", "linear", "circular"}, "none"});
  keys.azimuth = node.number({"azimuth_deg",
                              "direction of the field of linear light, from the plane of incidence (0: p, 90: s)",
                              {0, 360, false, true},
                              0.0});
  keys.size_share = node.number(
      {"size_share", "lit share of the face's length and width, around its center", {0, 1, true, false}, 0.2});
  keys.gap = node.number({"gap_mm", "air between source and face", Range::closed(0, 100), 0.0});
  keys.flux = node.number({"flux_lm", "luminous flux", Range::positive(1e9), 100.0});
  return {"beam", keys.face, [=](const SourcePlace& place) -> SourcePointer {
            return std::make_unique<Beam>(keys, place.lit(keys.face));
          }};
}

}  // namespace evenglow::tracer

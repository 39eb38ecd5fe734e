#include "tracer/sources/lambertian_face.h"

#include "core/math/sampling.h"

namespace evenglow::tracer {
namespace {

class LambertianFace final : public Source {
 public:
  LambertianFace(Side face, double gap, double flux, const Box& box)
      : face_(face), gap_(gap), flux_(flux), axes_(side_axes(face)), min_(box.min), max_(box.max) {
    const int axis = axis_of(face);
    min_[axis] = max_[axis] = box.plane(face) + (is_upper(face) ? gap : -gap);
  }

  double flux() const override { return flux_; }
  Side side() const override { return face_; }
  double gap() const override { return gap_; }

  Photon emit(core::PhotonRng& rng) const override {
    const double u1 = rng.uniform();
    const double u2 = rng.uniform();
    const core::Vec3 local = core::sample_lambertian(u1, u2);
    const core::Vec3 k = local.x() * axes_.a + local.y() * axes_.b + local.z() * axes_.inward;
    Photon photon;
    photon.position = min_;
    const core::Vec3 size = max_ - min_;
    photon.position += rng.uniform() * size.dot(axes_.a) * axes_.a;
    photon.position += rng.uniform() * size.dot(axes_.b) * axes_.b;
    photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    return photon;
  }

 private:
  Side face_;
  double gap_;
  double flux_;
  SideAxes axes_;
  core::Vec3 min_, max_;
};

}  // namespace

SourceSpec make_lambertian_face(const core::ConfigNode& node) {
  using core::Range;
  const Side face = read_side(
      node, {"face", "face of the backlight that is lit", {"left", "right", "front", "back", "bottom", "top"}, "left"});
  const double gap = node.number({"gap_mm", "air between source and face", Range::closed(0, 100), 0.0});
  const double flux = node.number({"flux_lm", "luminous flux", Range::positive(1e9), 100.0});
  return {"lambertian_face", face, [=](const SourcePlace& place) -> SourcePointer {
            return std::make_unique<LambertianFace>(face, gap, flux, place.lit(face));
          }};
}

}  // namespace evenglow::tracer

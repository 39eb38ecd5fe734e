#include "tracer/sources/lambertian_face.h"

#include "tracer/sources/pattern_keys.h"

namespace evenglow::tracer {
namespace {

class LambertianFace final : public Source {
 public:
  LambertianFace(Side face, double gap, double flux, EmissionPattern pattern, const Box& box)
      : face_(face),
        gap_(gap),
        flux_(flux),
        pattern_(std::move(pattern)),
        axes_(side_axes(face)),
        min_(box.min),
        max_(box.max) {
    const int axis = axis_of(face);
    min_[axis] = max_[axis] = box.plane(face) + (is_upper(face) ? gap : -gap);
    along_a_ = (max_ - min_).dot(axes_.a) * axes_.a;
    along_b_ = (max_ - min_).dot(axes_.b) * axes_.b;
  }

  double flux() const override { return flux_; }
  Side side() const override { return face_; }
  double gap() const override { return gap_; }
  std::string note() const override { return pattern_note(pattern_); }

  Photon emit(core::PhotonRng& rng) const override {
    const core::Vec3 k = pattern_.sample(rng, axes_);
    Photon photon;
    const double a = rng.uniform();
    photon.position = min_ + a * along_a_ + rng.uniform() * along_b_;
    photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    return photon;
  }

 private:
  Side face_;
  double gap_;
  double flux_;
  EmissionPattern pattern_;
  SideAxes axes_;
  core::Vec3 min_, max_, along_a_, along_b_;
};

}  // namespace

SourceSpec make_lambertian_face(const core::ConfigNode& node) {
  using core::Range;
  const Side face = read_side(
      node, {"face", "face of the backlight that is lit", {"left", "right", "front", "back", "bottom", "top"}, "left"});
  const double gap = node.number({"gap_mm", "air between source and face", Range::closed(0, 100), 0.0});
  EmissionPattern pattern = read_emission_pattern(node);
  double flux = node.number(
      {"flux_lm", "luminous flux; default: that of a pattern_file in cd, else 100", Range::positive(1e9), 100.0});
  if (!node.has("flux_lm")) flux = pattern.flux().value_or(flux);
  return {"lambertian_face", face, [=](const SourcePlace& place) -> SourcePointer {
            return std::make_unique<LambertianFace>(face, gap, flux, pattern, place.lit(face));
          }};
}

}  // namespace evenglow::tracer

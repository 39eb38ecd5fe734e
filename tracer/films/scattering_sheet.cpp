#include "tracer/films/scattering_sheet.h"

#include <cmath>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

/// Rounding of k and e1 grows from event to event; taken out each time.
void renormalize(core::PolarizationFrame& frame) {
  frame.k.normalize();
  frame.e1 = (frame.e1 - frame.e1.dot(frame.k) * frame.k).normalized();
}

/// Reflected or refracted light; a clear face absorbs nothing.
core::StokesVector at_face(const DielectricFace& face, const core::StokesVector& light, core::PhotonRng& rng) {
  const auto sample = face.sample(light, rng);
  return sample ? sample->light : light;
}

}  // namespace

ScatteringSheet::ScatteringSheet(const DielectricSheet& sheet)
    : sheet_(sheet), bottom_(1.0, sheet.refractive_index), top_(sheet.refractive_index, 1.0) {
  core::expects(sheet.scattering && sheet.scattering->coefficient > 0.0, "a scattering sheet scatters");
}

std::optional<BsdfSample> ScatteringSheet::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const bool from_below = incident.frame.k.z() > 0.0;
  double z = from_below ? 0.0 : sheet_.thickness;
  core::StokesVector light = at_face(from_below ? bottom_ : top_, incident, rng);
  if ((light.frame.k.z() > 0.0) != from_below) return BsdfSample{light, true};
  double optical_depth = -std::log(rng.uniform());  // left until absorbed
  for (int event = 0; event < kMaxEvents; ++event) {
    const double cosine = light.frame.k.z();
    const double to_face = (cosine > 0.0 ? sheet_.thickness - z : -z) / cosine;
    const double way = sheet_.scattering->free_path(rng);
    const bool scattered = cosine == 0.0 || way < to_face;
    optical_depth -= sheet_.absorption * (scattered ? way : to_face);
    if (optical_depth <= 0.0) return std::nullopt;
    if (scattered) {
      z += way * cosine;
      light = sheet_.scattering->scatter(light, rng);
      renormalize(light.frame);
      continue;
    }
    const bool upward = cosine > 0.0;
    z = upward ? sheet_.thickness : 0.0;
    light = at_face(upward ? top_ : bottom_, light, rng);
    renormalize(light.frame);
    if ((light.frame.k.z() > 0.0) == upward) return BsdfSample{light, true};
  }
  return std::nullopt;
}

core::StokesVector ScatteringSheet::evaluate(const core::StokesVector&, const core::Vec3& k_out) const {
  return core::StokesVector::unpolarized(0.0, core::PolarizationFrame::any(k_out));
}

Bsdf::Specular ScatteringSheet::specular(const core::Vec3& k) const {
  return incoherent_sheet(std::abs(k.z()), sheet_.refractive_index, sheet_.absorption + sheet_.scattering->coefficient,
                          sheet_.thickness);
}

}  // namespace evenglow::tracer

#include "tracer/films/ideal_polarizer.h"

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

core::MuellerMatrix turned_diattenuator(double pass, double block, const AxisAngle& chi) {
  return turned(core::diattenuator(pass, block), chi);
}

}  // namespace

IdealPolarizer::IdealPolarizer(const Powers& powers, double axis, double index)
    : powers_(powers), axis_(axis), index_(index) {
  const auto allowed = [](double t, double r) { return t >= 0.0 && r >= 0.0 && t + r <= 1.0 + 1e-12; };
  core::expects(allowed(powers.transmittance_pass, powers.reflectance_pass) &&
                    allowed(powers.transmittance_block, powers.reflectance_block),
                "a polarizer's T and R are not negative and T + R is at most 1");
}

Bsdf::Specular IdealPolarizer::matrices(const TangentialFrame& frame) const {
  const AxisAngle chi = pass_axis(axis_.cos_psi(frame), axis_.sin_psi(frame), frame.sin_polar, index_);
  Specular s;
  s.transmission = turned_diattenuator(powers_.transmittance_pass, powers_.transmittance_block, chi);
  s.reflection = powers_.keeps_reflected_state
                     ? 0.5 * (powers_.reflectance_pass + powers_.reflectance_block) * core::MuellerMatrix::Identity()
                     : turned_diattenuator(powers_.reflectance_pass, powers_.reflectance_block, chi);
  return s;
}

}  // namespace evenglow::tracer

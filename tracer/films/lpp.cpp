#include "tracer/films/lpp.h"

namespace evenglow::tracer {

IdealPolarizer lpp_surface(const LppSpec& spec) {
  IdealPolarizer::Powers powers;
  powers.transmittance_pass = spec.k1;
  powers.transmittance_block = spec.k2;
  powers.reflectance_pass = powers.reflectance_block = spec.reflectance;
  powers.keeps_reflected_state = true;
  return IdealPolarizer(powers, spec.axis, kLppIndex);
}

}  // namespace evenglow::tracer

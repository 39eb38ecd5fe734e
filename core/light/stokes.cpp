#include "core/light/stokes.h"

#include <cmath>

namespace evenglow::core {

StokesVector StokesVector::linear(double power, double angle, const PolarizationFrame& frame) {
  return {power, power * std::cos(2.0 * angle), power * std::sin(2.0 * angle), 0.0, frame};
}

double StokesVector::degree_of_polarization() const {
  return I > 0.0 ? std::sqrt(Q * Q + U * U + V * V) / I : 0.0;
}

}  // namespace evenglow::core

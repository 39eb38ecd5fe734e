#include "tracer/optics/lobe_width.h"

#include <cmath>
#include <numbers>

namespace evenglow::tracer {
namespace {

constexpr double kLeastShare = 1.0 / 12.0;

/// Mean of the scattered light at `angle` from the direction `side` z.
double scattered(const Bsdf& surface, double side, double angle) {
  constexpr int kAzimuths = 8;
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(core::Vec3(0, 0, 1)));
  double sum = 0.0;
  for (int i = 0; i < kAzimuths; ++i) {
    const double azimuth = 2.0 * std::numbers::pi * i / kAzimuths;
    const core::Vec3 k(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                       side * std::cos(angle));
    sum += surface.evaluate(light, k).I;
  }
  return sum / kAzimuths;
}

}  // namespace

bool spreads_over(const Bsdf& surface, double least) {
  const double passed = scattered(surface, 1.0, 0.0);
  const double side = passed > 0.0 ? 1.0 : -1.0;
  const double straight = passed > 0.0 ? passed : scattered(surface, -1.0, 0.0);
  return scattered(surface, side, least) >= kLeastShare * straight;
}

}  // namespace evenglow::tracer

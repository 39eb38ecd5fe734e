#include "tracer/films/haze.h"

#include <algorithm>
#include <cmath>

#include "tracer/films/diffuser.h"
#include "tracer/films/symmetric_lobe.h"

namespace evenglow::tracer {
namespace {

constexpr double kLeast = 1.0 * core::kRadPerDeg;
constexpr double kLargest = 150.0 * core::kRadPerDeg;
constexpr int kPanels = 64;
constexpr int kSteps = 60;

}  // namespace

double gaussian_haze(double fwhm) {
  // 1 minus the integral of f over the disk of 2.5 degrees: Simpson's rule for 2 pi b f.
  const SymmetricLobe lobe(Diffuser::lobe_width(fwhm));
  const double edge = std::sin(kHazeAngle);
  double inside = 0.0;
  for (int i = 0; i <= 2 * kPanels; ++i) {
    const double b = edge * i / (2.0 * kPanels);
    const double weight = i == 0 || i == 2 * kPanels ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    inside += weight * b * lobe.value(0.0, b, b * b);
  }
  return std::clamp(1.0 - 2.0 * core::kPi * inside * edge / (6.0 * kPanels), 0.0, 1.0);
}

std::optional<double> fwhm_of_haze(double haze) {
  double low = kLeast, high = kLargest;
  if (haze <= gaussian_haze(low) || haze > gaussian_haze(high)) return std::nullopt;
  for (int step = 0; step < kSteps && high - low > 1e-9; ++step) {
    const double middle = 0.5 * (low + high);
    (gaussian_haze(middle) < haze ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace evenglow::tracer

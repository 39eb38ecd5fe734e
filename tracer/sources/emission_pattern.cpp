#include "tracer/sources/emission_pattern.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/lambertian.h"
#include "core/math/sampling.h"

namespace evenglow::tracer {
namespace {

/// Share of the way along a cell edge on which the density goes linearly from f0 to f1: inversion of its distribution.
double sample_linear(double u, double f0, double f1) {
  const double root = std::sqrt(f0 * f0 + u * (f1 * f1 - f0 * f0));
  const double sum = f0 + root;
  return sum > 0.0 ? u * (f0 + f1) / sum : u;
}

}  // namespace

EmissionPattern EmissionPattern::cosine_power(double n) {
  EmissionPattern pattern;
  pattern.exponent_ = n;
  return pattern;
}

EmissionPattern EmissionPattern::tabulated(const IntensityTable& table, double turn, bool absolute) {
  EmissionPattern pattern;
  pattern.turn_ = turn;
  pattern.table_ = front_hemisphere(table);
  const IntensityTable& front = pattern.table_;
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < front.phi.size(); ++i) {
    for (std::size_t j = 0; j + 1 < front.theta.size(); ++j) {
      pattern.cumulative_.push_back(sum += cell_flux(front, i, j));
    }
  }
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    throw core::Error("must hold light within 90 degrees of the normal, got none");
  }
  const double whole = total_flux(table);
  pattern.left_out_ = std::clamp(1.0 - sum / whole, 0.0, 1.0);
  if (absolute) pattern.flux_ = sum;
  return pattern;
}

core::Vec3 EmissionPattern::sample(core::PhotonRng& rng, const SideAxes& axes) const {
  if (!cumulative_.empty()) return sample_table(rng, axes);
  core::Vec3 local;
  if (exponent_ == 1.0) {
    local = core::draw_lambertian(rng);
  } else {
    const double u = rng.uniform();
    local = core::sample_cosine_power(u, rng.uniform(), exponent_);
  }
  return local.x() * axes.a + local.y() * axes.b + local.z() * axes.inward;
}

core::Vec3 EmissionPattern::sample_table(core::PhotonRng& rng, const SideAxes& axes) const {
  const double at = rng.uniform() * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
  const auto cell = static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
  const std::size_t i = cell / (table_.theta.size() - 1);
  const std::size_t j = cell % (table_.theta.size() - 1);
  // Within the cell the density in cos(theta) is the mean over phi, linear in theta: rejection of a uniform cos(theta).
  const double f0 = table_.at(i, j) + table_.at(i + 1, j);
  const double f1 = table_.at(i, j + 1) + table_.at(i + 1, j + 1);
  const double cos0 = std::cos(table_.theta[j]);
  const double cos1 = std::cos(table_.theta[j + 1]);
  const double width = table_.theta[j + 1] - table_.theta[j];
  double cos_theta = 0.0;
  double v = 0.0;
  do {
    cos_theta = cos0 + rng.uniform() * (cos1 - cos0);
    v = std::clamp((std::acos(std::clamp(cos_theta, -1.0, 1.0)) - table_.theta[j]) / width, 0.0, 1.0);
  } while (rng.uniform() * std::max(f0, f1) > f0 + v * (f1 - f0));
  const double g0 = (1.0 - v) * table_.at(i, j) + v * table_.at(i, j + 1);
  const double g1 = (1.0 - v) * table_.at(i + 1, j) + v * table_.at(i + 1, j + 1);
  const double u = sample_linear(rng.uniform(), g0, g1);
  const double phi = table_.phi[i] + u * (table_.phi[i + 1] - table_.phi[i]) + turn_;
  // Never along the plane of the window itself.
  cos_theta = std::max(cos_theta, 1e-12);
  const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta));
  const core::Vec3 right = axes.inward.cross(axes.b);
  return sin_theta * (std::cos(phi) * right + std::sin(phi) * axes.b) + cos_theta * axes.inward;
}

}  // namespace evenglow::tracer

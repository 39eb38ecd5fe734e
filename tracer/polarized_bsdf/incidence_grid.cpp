#include "tracer/polarized_bsdf/incidence_grid.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kBelowOne = 1.0 - 0x1.0p-53;

}  // namespace

IncidenceGrid::IncidenceGrid() {
  for (std::size_t k = 0; k <= kPsi; ++k) {
    cos_psi_[k] = std::cos(core::kPi * static_cast<double>(k) / static_cast<double>(kPsi));
    sin_psi_[k] = std::sin(core::kPi * static_cast<double>(k) / static_cast<double>(kPsi));
  }
  for (const double degrees :
       std::array<double, kSigma>{0.0,  5.0,  10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0,
                                  60.0, 64.0, 68.0, 71.0, 74.0, 77.0, 80.0, 82.5, 85.0, 87.0, 88.5, 89.5}) {
    sigma_.push_back(degrees * core::kRadPerDeg);
    sin_.push_back(std::sin(sigma_.back()));
    cos2_.push_back(std::cos(sigma_.back()) * std::cos(sigma_.back()));
    steps_[cos2_.size() - 1] = static_cast<float>(cos2_.back());
  }
  for (std::size_t i = 0; i + 1 < cos2_.size(); ++i) inverse_.push_back(1.0 / (cos2_[i] - cos2_[i + 1]));
}

double IncidenceGrid::psi(std::size_t node) const {
  const std::size_t row = node / cos2_.size();
  return static_cast<double>(row) * core::kPi / static_cast<double>(kPsi);
}

double IncidenceGrid::sigma(std::size_t node) const {
  return sigma_[node % cos2_.size()];
}

double IncidenceGrid::psi_of(double cos_psi, double sin_psi) const {
  const double fold = sin_psi < 0.0 ? -1.0 : 1.0;
  const double c = fold * cos_psi, s = fold * sin_psi;
  int passed = 0;
  for (std::size_t k = 1; k < kPsi; ++k) passed += s * cos_psi_[k] >= c * sin_psi_[k] ? 1 : 0;
  const auto k = static_cast<std::size_t>(passed);
  const double way = s * cos_psi_[k] - c * sin_psi_[k];
  const double rest = c * sin_psi_[k + 1] - s * cos_psi_[k + 1];
  const double share = std::clamp(way / (way + rest), 0.0, kBelowOne);
  return (static_cast<double>(k) + share) * (core::kPi / static_cast<double>(kPsi));
}

IncidenceGrid::Place IncidenceGrid::place(double psi, double cos2) const {
  Place p{};
  const double turn = psi * (static_cast<double>(kPsi) / core::kPi);
  p.psi0 = std::min(static_cast<std::size_t>(std::max(turn, 0.0)), kPsi - 1);
  p.psi1 = (p.psi0 + 1) % kPsi;
  p.psi_share = std::clamp(turn - static_cast<double>(p.psi0), 0.0, 1.0);
  const auto step = static_cast<float>(cos2);
  int below = 0;  // nodes steeper than the ray; a plain sum, which the compiler vectorizes
  for (const float c : steps_) below += c > step ? 1 : 0;
  p.sigma0 = static_cast<std::size_t>(std::clamp(below, 1, static_cast<int>(kSigma) - 1) - 1);
  p.sigma1 = p.sigma0 + 1;
  p.sigma_share = std::clamp((cos2_[p.sigma0] - cos2) * inverse_[p.sigma0], 0.0, 1.0);
  return p;
}

IncidenceGrid::Cell IncidenceGrid::cell(double psi, double cos2) const {
  const Place p = place(psi, cos2);
  Cell c;
  c.node = {index(p.psi0, p.sigma0), index(p.psi1, p.sigma0), index(p.psi0, p.sigma1), index(p.psi1, p.sigma1)};
  c.weight = {(1.0 - p.psi_share) * (1.0 - p.sigma_share), p.psi_share * (1.0 - p.sigma_share),
              (1.0 - p.psi_share) * p.sigma_share, p.psi_share * p.sigma_share};
  return c;
}

std::size_t IncidenceGrid::draw(double psi, double cos2, double uniform) const {
  const Place p = place(psi, cos2);
  const bool next_psi = uniform < p.psi_share;
  const double rest = (next_psi ? uniform : uniform - p.psi_share) / (next_psi ? p.psi_share : 1.0 - p.psi_share);
  return index(next_psi ? p.psi1 : p.psi0, rest < p.sigma_share ? p.sigma1 : p.sigma0);
}

}  // namespace evenglow::tracer

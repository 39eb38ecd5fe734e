#include "tracer/polarized_bsdf/sampled_mueller.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/sampled_mueller_builder.h"

namespace evenglow::tracer {
namespace {

constexpr double kTurn = 2.0 * core::kPi;

}  // namespace

SampledMueller::SampledMueller(const MuellerTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                               double pass_index)
    : cells_(2 * kCells) {
  find_widest();
  MuellerResampler resampler(table, wavelength_nm, hemispherical, pass_index, kU, kPhi);
  points_.reserve(grid_.size() * 2 * kPoints);
  for (std::size_t node = 0; node < grid_.size(); ++node) {
    const ResampledMuellerNode resampled = resampler.node(grid_.psi(node), grid_.sigma(node));
    // From the numbers as stored, so that they are those of what is drawn.
    std::array<Eigen::Vector4d, 2> integral{Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
    for (std::size_t kind = 0; kind < 2; ++kind) {
      for (std::size_t i = 0; i < kPoints; ++i) {
        points_.push_back(resampled.kinds[kind][i].cast<float>());
        integral[kind] += resampled.weights[i] * points_.back().row(0).transpose().cast<double>();
      }
    }
    integrals_.push_back(integral);
    add_cells(node);
  }
  remarks_ = resampler.remarks();
}

void SampledMueller::find_widest() {
  for (const double sigma : grid_.sigmas()) {
    const double cosine = std::cos(sigma);
    std::array<double, kPhi + 1> r{};
    for (std::size_t k = 0; k <= kPhi; ++k) {
      const double phi = kTurn * static_cast<double>(k) / static_cast<double>(kPhi);
      r[k] = horizon_distance(std::sin(sigma), cosine * cosine, std::cos(phi), std::sin(phi));
    }
    std::array<double, kPhi> widest{};
    for (std::size_t k = 0; k < kPhi; ++k) widest[k] = std::pow(std::max(r[k], r[k + 1]), 2);  // r is monotone there
    widest_.push_back(widest);
  }
}

double SampledMueller::peak(std::size_t node, std::size_t kind, std::size_t iphi, std::size_t iu) const {
  const Eigen::Matrix4f* here = points(node, kind) + iphi * kRing + iu;
  const Eigen::Matrix4f* next = points(node, kind) + (iphi + 1) % kPhi * kRing + iu;
  return static_cast<double>(std::max(std::max(here[0](0, 0), here[1](0, 0)), std::max(next[0](0, 0), next[1](0, 0))));
}

/// Proposals: a cell with the odds of max m00 x max r^2 x integral of 2 u^3, in it u^4 and phi' uniform.
void SampledMueller::add_cells(std::size_t node) {
  std::vector<double> bounds(2 * kCells);
  const std::array<double, kPhi>& widest = widest_[grid_.sigma_index(node)];
  for (std::size_t cell = 0; cell < bounds.size(); ++cell) {
    const std::size_t iphi = cell % kCells / kU;
    const auto u = static_cast<double>(cell % kU);
    bounds[cell] = peak(node, cell / kCells, iphi, cell % kU) * widest[iphi] * (std::pow(u + 1.0, 4) - std::pow(u, 4));
  }
  cells_.add(bounds);
}

core::MuellerMatrix SampledMueller::response(std::size_t node, ScatterKind kind, double u, double phi) const {
  const double su = std::clamp(u, 0.0, 1.0) * static_cast<double>(kU);
  const double sphi = std::max(phi, 0.0) * (static_cast<double>(kPhi) / kTurn);
  const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
  const std::size_t iphi = std::min(static_cast<std::size_t>(sphi), kPhi - 1);
  const double tu = su - static_cast<double>(iu);
  const double tphi = std::min(1.0, sphi - static_cast<double>(iphi));
  const Eigen::Matrix4f* here = points(node, static_cast<std::size_t>(kind)) + iphi * kRing + iu;
  const Eigen::Matrix4f* next = points(node, static_cast<std::size_t>(kind)) + (iphi + 1) % kPhi * kRing + iu;
  const double r = horizon_distance(grid_.sin_sigma(node), grid_.cos2_sigma(node), std::cos(phi), std::sin(phi));
  return r * r *
         ((1.0 - tphi) * ((1.0 - tu) * here[0].cast<double>() + tu * here[1].cast<double>()) +
          tphi * ((1.0 - tu) * next[0].cast<double>() + tu * next[1].cast<double>()));
}

SampledMueller::Draw SampledMueller::draw(std::size_t node, const Eigen::Vector4d& s, core::PhotonRng& rng) const {
  // No direction takes more than this times m00.
  const double most = 1.0 + std::min(1.0, s.tail<3>().norm());
  const std::array<double, kPhi>& widest = widest_[grid_.sigma_index(node)];
  while (true) {
    const std::size_t cell = cells_.draw(node, rng.uniform());
    const std::size_t kind = cell / kCells;
    const std::size_t iphi = cell % kCells / kU;
    const auto low = static_cast<double>(cell % kU);
    const double low4 = std::pow(low, 4), high4 = std::pow(low + 1.0, 4);
    Draw d;
    d.kind = static_cast<ScatterKind>(kind);
    const double su = std::pow(low4 + (high4 - low4) * rng.uniform(), 0.25);
    d.u = std::clamp(su, low, low + 1.0) / static_cast<double>(kU);
    const double phi = kTurn * (static_cast<double>(iphi) + rng.uniform()) / static_cast<double>(kPhi);
    const double power = response(node, d.kind, d.u, phi).row(0).dot(s.transpose());
    if (rng.uniform() * most * peak(node, kind, iphi, cell % kU) * widest[iphi] < power) {
      d.cos_phi = std::cos(phi);
      d.sin_phi = std::sin(phi);
      return d;
    }
  }
}

std::size_t SampledMueller::bytes() const {
  return points_.size() * sizeof(Eigen::Matrix4f) + cells_.bytes();
}

}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/sampled_bsdf.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/math/select.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

/// cos and sin of an angle within 0.175 rad of 0, to 1e-13 and 4e-13.
void small_sincos(double a, double& cosine, double& sine) {
  const double a2 = a * a;
  cosine = 1.0 + a2 * (-1.0 / 2 + a2 * (1.0 / 24 + a2 * (-1.0 / 720 + a2 / 40320)));
  sine = a * (1.0 + a2 * (-1.0 / 6 + a2 * (1.0 / 120 + a2 * (-1.0 / 5040 + a2 / 362880))));
}

}  // namespace

SampledBsdf::Lobes SampledBsdf::value(std::size_t index, std::size_t point) const {
  const Point& p = points_[index * kPoints + point];
  const double a = p.root_a * axes_[index].unit_a;
  const double b = p.root_b * axes_[index].unit_b;
  return {a * a, b * b, 2.0 * kInt16 * p.y * a * b};
}

SampledBsdf::Lobes SampledBsdf::bilinear(std::size_t index, std::size_t iu, std::size_t iphi, double tu,
                                         double tphi) const {
  const Point* const here = points_.data() + index * kPoints + iphi * kRing + iu;
  const Point* const next = iphi + 1 == kPhi ? here - (kPhi - 1) * kRing : here + kRing;
  // Single precision holds the products of the packed numbers to 6e-8 of themselves.
  using Lanes = float __attribute__((vector_size(16)));
  const Lanes a{static_cast<float>(here[0].root_a), static_cast<float>(here[1].root_a),
                static_cast<float>(next[0].root_a), static_cast<float>(next[1].root_a)};
  const Lanes b{static_cast<float>(here[0].root_b), static_cast<float>(here[1].root_b),
                static_cast<float>(next[0].root_b), static_cast<float>(next[1].root_b)};
  const Lanes y{static_cast<float>(here[0].y), static_cast<float>(here[1].y), static_cast<float>(next[0].y),
                static_cast<float>(next[1].y)};
  const auto u = static_cast<float>(tu), v = static_cast<float>(tphi);
  const Lanes weight{(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v};
  const auto sum = [](const Lanes& lanes) {
    return static_cast<double>((lanes[0] + lanes[1]) + (lanes[2] + lanes[3]));
  };
  const Lanes wa = weight * a;
  const Axis& axis = axes_[index];
  return {sum(wa * a) * axis.square_a, sum(weight * b * b) * axis.square_b, sum(wa * b * y) * axis.product};
}

double SampledBsdf::kappa(std::size_t index, std::size_t iu, std::size_t iphi, double tu, double tphi) const {
  if (kappas_.empty()) return 1.0;
  const float* const here = kappas_.data() + index * kPoints + iphi * kRing + iu;
  const float* const next = iphi + 1 == kPhi ? here - (kPhi - 1) * kRing : here + kRing;
  const auto along_u = [tu](const float* line) {
    return (1.0 - tu) * static_cast<double>(line[0]) + tu * static_cast<double>(line[1]);
  };
  return (1.0 - tphi) * along_u(here) + tphi * along_u(next);
}

SampledBsdf::Response SampledBsdf::turned(const Lobes& lobes, std::size_t index) const {
  const Axis& axis = axes_[index];
  const double x = lobes.b - lobes.a;
  return {lobes.a + lobes.b, x * axis.x - lobes.y * axis.y, x * axis.y + lobes.y * axis.x, 1.0};
}

SampledBsdf::Response SampledBsdf::response(std::size_t node, ScatterKind kind, double u, double phi, double cos_phi,
                                            double sin_phi) const {
  const double su = std::clamp(u, 0.0, 1.0) * static_cast<double>(kU);
  const Held& held = held_[node];
  const double seen = held.mirror > 0.0 ? phi : 2.0 * core::kPi - phi;
  const double sphi = std::max(0.0, seen * (static_cast<double>(kPhi) / (2.0 * core::kPi)));
  const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
  const std::size_t iphi = std::min(static_cast<std::size_t>(sphi), kPhi - 1);
  const double tu = su - static_cast<double>(iu);
  const double tphi = sphi - static_cast<double>(iphi);
  const std::size_t i = index(held.place, static_cast<std::size_t>(kind));
  const double distance = horizon_distance(grid_.sin_sigma(node), grid_.cos2_sigma(node), cos_phi, sin_phi);
  Response r = turned(bilinear(i, iu, iphi, tu, tphi), i);
  const double r2 = distance * distance;
  return {r.S * r2, r.x * r2, held.mirror * r.y * r2, kappa(i, iu, iphi, tu, tphi)};
}

SampledBsdf::Draw SampledBsdf::draw(std::size_t node, double q1, double q2, core::PhotonRng& rng) const {
  constexpr double kStep = 2.0 * core::kPi / static_cast<double>(kRows);
  const double sin_in = grid_.sin_sigma(node);
  const double cos2_in = grid_.cos2_sigma(node);
  const auto [place, mirror] = held_[node];
  // Shares of the two lobes of each kind, and their proposals' sums.
  std::array<double, kKinds> along{}, across{};
  std::array<double, kLobes> odds{};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const Axis& axis = axes_[index(place, kind)];
    const double seen_q2 = mirror * q2;
    along[kind] = std::clamp(axis.x * q1 + axis.y * seen_q2, -1.0, 1.0);
    across[kind] = axis.x * seen_q2 - axis.y * q1;
    odds[2 * kind] = 0.5 * (1.0 + along[kind]) * axis.total_a;
    odds[2 * kind + 1] = 0.5 * (1.0 - along[kind]) * axis.total_b;
  }
  const std::array<double, kLobes> before{0.0, odds[0], odds[0] + odds[1], odds[0] + odds[1] + odds[2]};
  const double sum = before[3] + odds[3];
  while (true) {
    const double at = rng.uniform() * sum;
    // Comparisons added up instead of a search: no branch that cannot be guessed.
    const std::size_t lobe = static_cast<std::size_t>(at >= before[1]) + static_cast<std::size_t>(at >= before[2]) +
                             static_cast<std::size_t>(at >= before[3]);
    const LobeProposals::Block block =
        proposals_.draw(kLobes * place + lobe, std::min((at - before[lobe]) / odds[lobe], kBelowOne));
    const double low4 = u4_[block.column];
    const double span4 = u4_[block.column + 1] - low4;
    const double su = std::sqrt(std::sqrt(low4 + span4 * rng.uniform()));
    const double turn = rng.uniform();

    const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
    const double sphi = turn * static_cast<double>(kBlock);
    const auto part = static_cast<std::size_t>(sphi);
    const std::size_t kind = lobe / 2;
    const std::size_t i = index(place, kind);
    const double tu = std::min(su - static_cast<double>(iu), 1.0);
    const double tphi = sphi - static_cast<double>(part);
    const Lobes lobes = bilinear(i, iu, block.row * kBlock + part, tu, tphi);

    double c = 1.0, s = 0.0;
    small_sincos((turn - 0.5) * kStep, c, s);
    const double cos_phi = cos_row_[block.row] * c - sin_row_[block.row] * s;
    const double sin_phi = sin_row_[block.row] * c + cos_row_[block.row] * s;
    const double r = horizon_distance(sin_in, cos2_in, cos_phi, sin_phi);
    // The bound is for lobe + |Y| / 2; of all that the two lobes propose here, `power` is wanted.
    const double slack = 0.5 * std::abs(lobes.y);
    const double share_a = 0.5 * (1.0 + along[kind]), share_b = 0.5 * (1.0 - along[kind]);
    const double proposed = share_a * lobes.a + share_b * lobes.b + slack;
    const double power = proposed - slack - 0.5 * lobes.y * across[kind];
    const double bounded = core::select(lobe % 2 == 0, lobes.a, lobes.b) + slack;
    if (rng.uniform() * block.weight * proposed < bounded * r * r * span4 * power) {
      Draw d{static_cast<ScatterKind>(kind), su * (1.0 / static_cast<double>(kU)), cos_phi, mirror * sin_phi,
             turned(lobes, i)};
      d.response.y *= mirror;
      d.response.kappa = kappa(i, iu, block.row * kBlock + part, tu, tphi);
      return d;
    }
  }
}

std::size_t SampledBsdf::bytes() const {
  return points_.size() * sizeof(Point) + kappas_.size() * sizeof(float) + proposals_.bytes();
}

}  // namespace evenglow::tracer

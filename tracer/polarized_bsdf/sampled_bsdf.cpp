#include "tracer/polarized_bsdf/sampled_bsdf.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/sampled_bsdf_builder.h"

namespace evenglow::tracer {
namespace {

constexpr double kInt16 = 1.0 / 32767.0;

/// cos and sin of an angle below 0.175 rad, to 1e-13 and 4e-13.
void small_sincos(double a, double& cosine, double& sine) {
  const double a2 = a * a;
  cosine = 1.0 + a2 * (-1.0 / 2 + a2 * (1.0 / 24 + a2 * (-1.0 / 720 + a2 / 40320)));
  sine = a * (1.0 + a2 * (-1.0 / 6 + a2 * (1.0 / 120 + a2 * (-1.0 / 5040 + a2 / 362880))));
}

}  // namespace

SampledBsdf::SampledBsdf(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                         double pass_index)
    : cells_(2 * kCells) {
  for (std::size_t k = 0; k <= kPhi; ++k) {
    const double phi = 2.0 * core::kPi * static_cast<double>(k) / static_cast<double>(kPhi);
    cos_phi_[k] = std::cos(phi);
    sin_phi_[k] = std::sin(phi);
  }
  find_widest();
  const ResamplingShape shape{kU, kPhi};
  Resampler resampler(table, wavelength_nm, hemispherical, pass_index, shape);
  points_.reserve(grid_.size() * 2 * kPoints);
  std::vector<double> bounds;
  for (std::size_t node = 0; node < grid_.size(); ++node) {
    const ResampledNode resampled = resampler.node(grid_.psi(node), grid_.sigma(node));
    for (const auto& kind : resampled.kinds) {
      for (const ResampledPoint& p : kind) {
        points_.push_back({static_cast<float>(p.S), static_cast<std::int16_t>(p.x / kInt16),
                           static_cast<std::int16_t>(p.y / kInt16)});
        if (resampler.has_kappa()) kappas_.push_back(static_cast<float>(p.kappa));
      }
    }
    // From the numbers as stored, so that they are those of what is drawn.
    std::array<Response, 2> integral{};
    for (std::size_t kind = 0; kind < 2; ++kind) {
      const Point* p = points(node, kind);
      for (std::size_t i = 0; i < kPoints; ++i) {
        const double weight = resampled.weights[i] * static_cast<double>(p[i].S);
        integral[kind].S += weight;
        integral[kind].x += weight * kInt16 * p[i].x;
        integral[kind].y += weight * kInt16 * p[i].y;
      }
    }
    integrals_.push_back(integral);
    totals_.push_back({integral[0].S + integral[1].S, integral[0].x + integral[1].x, integral[0].y + integral[1].y});
    add_cell_bounds(node, bounds);
  }
  remarks_ = resampler.remarks();
}

void SampledBsdf::find_widest() {
  for (const double sigma : grid_.sigmas()) {
    const double cosine = std::cos(sigma);
    const auto r = [&](std::size_t k) {
      return horizon_distance(std::sin(sigma), cosine * cosine, cos_phi_[k], sin_phi_[k]);
    };
    std::array<double, kPhi> widest{};
    for (std::size_t k = 0; k < kPhi; ++k) widest[k] = std::pow(std::max(r(k), r(k + 1)), 2);  // r is monotone there
    widest_.push_back(widest);
  }
}

/// Proposals: a cell with the odds of max S x max r^2 x integral of 2 u^3, in it u^4 and phi' uniform.
void SampledBsdf::add_cell_bounds(std::size_t node, std::vector<double>& bounds) {
  bounds.assign(2 * kCells, 0.0);
  const std::array<double, kPhi>& widest = widest_[grid_.sigma_index(node)];
  for (std::size_t kind = 0; kind < 2; ++kind) {
    const Point* p = points(node, kind);
    for (std::size_t k = 0; k < kPhi; ++k) {
      const Point* here = p + k * kRing;
      const Point* next = p + (k + 1) % kPhi * kRing;
      for (std::size_t i = 0; i < kU; ++i) {
        const double peak = std::max(std::max(here[i].S, here[i + 1].S), std::max(next[i].S, next[i + 1].S));
        const double u0 = static_cast<double>(i);
        bounds[(kind * kPhi + k) * kU + i] = peak * widest[k] * (std::pow(u0 + 1.0, 4) - std::pow(u0, 4));
      }
    }
  }
  cells_.add(bounds);
}

SampledBsdf::Response SampledBsdf::bilinear(std::size_t node, std::size_t kind, std::size_t iu, std::size_t iphi,
                                            double tu, double tphi) const {
  const std::size_t base = (node * 2 + kind) * kPoints;
  const std::size_t here = base + iphi * kRing + iu;
  const std::size_t next = base + (iphi + 1 == kPhi ? 0 : iphi + 1) * kRing + iu;
  Response r{0.0, 0.0, 0.0, 1.0};
  const auto add = [&](const Point& p, double weight) {
    const double S = weight * static_cast<double>(p.S);
    r.S += S;
    r.x += S * kInt16 * p.x;
    r.y += S * kInt16 * p.y;
  };
  const double w00 = (1.0 - tu) * (1.0 - tphi), w10 = tu * (1.0 - tphi), w01 = (1.0 - tu) * tphi, w11 = tu * tphi;
  add(points_[here], w00);
  add(points_[here + 1], w10);
  add(points_[next], w01);
  add(points_[next + 1], w11);
  if (!kappas_.empty()) {
    r.kappa = w00 * static_cast<double>(kappas_[here]) + w10 * static_cast<double>(kappas_[here + 1]) +
              w01 * static_cast<double>(kappas_[next]) + w11 * static_cast<double>(kappas_[next + 1]);
  }
  return r;
}

SampledBsdf::Response SampledBsdf::response(std::size_t node, ScatterKind kind, double u, double phi, double cos_phi,
                                            double sin_phi) const {
  const double su = std::clamp(u, 0.0, 1.0) * static_cast<double>(kU);
  const double sphi = phi * (static_cast<double>(kPhi) / (2.0 * core::kPi));
  const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
  const std::size_t iphi = std::min(static_cast<std::size_t>(sphi), kPhi - 1);
  Response r = bilinear(node, static_cast<std::size_t>(kind), iu, iphi, su - static_cast<double>(iu),
                        sphi - static_cast<double>(iphi));
  const double distance = horizon_distance(grid_.sin_sigma(node), grid_.cos2_sigma(node), cos_phi, sin_phi);
  const double r2 = distance * distance;
  r.S *= r2;
  r.x *= r2;
  r.y *= r2;
  return r;
}

SampledBsdf::Draw SampledBsdf::draw(std::size_t node, double q1, double q2, core::PhotonRng& rng) const {
  constexpr double kStep = 2.0 * core::kPi / static_cast<double>(kPhi);
  const double sin_in = grid_.sin_sigma(node);
  const double cos2_in = grid_.cos2_sigma(node);
  // No direction takes more than this share of S.
  const double most = 0.5 * (1.0 + std::min(1.0, std::sqrt(q1 * q1 + q2 * q2)));
  const std::array<double, kPhi>& widest = widest_[grid_.sigma_index(node)];
  Draw d;
  while (true) {
    const std::size_t cell = cells_.draw(node, rng.uniform());
    const std::size_t kind = cell / kCells;
    const std::size_t iphi = cell % kCells / kU;
    const std::size_t iu = cell % kU;
    const double low = static_cast<double>(iu);
    const double low4 = low * low * low * low;
    const double high4 = (low + 1.0) * (low + 1.0) * (low + 1.0) * (low + 1.0);
    const double su = std::sqrt(std::sqrt(low4 + (high4 - low4) * rng.uniform()));
    const double tphi = rng.uniform();
    double c = 1.0, s = 0.0;
    small_sincos(tphi * kStep, c, s);
    d.cos_phi = cos_phi_[iphi] * c - sin_phi_[iphi] * s;
    d.sin_phi = sin_phi_[iphi] * c + cos_phi_[iphi] * s;
    d.response = bilinear(node, kind, iu, iphi, std::clamp(su - low, 0.0, 1.0), tphi);
    const double r = horizon_distance(sin_in, cos2_in, d.cos_phi, d.sin_phi);
    const Point* here = points(node, kind) + iphi * kRing + iu;
    const Point* next = points(node, kind) + (iphi + 1) % kPhi * kRing + iu;
    const double peak = static_cast<double>(std::max(std::max(here[0].S, here[1].S), std::max(next[0].S, next[1].S)));
    if (rng.uniform() * most * peak * widest[iphi] < d.response.power(q1, q2) * r * r) {
      d.kind = static_cast<ScatterKind>(kind);
      d.u = su / static_cast<double>(kU);
      return d;
    }
  }
}

std::size_t SampledBsdf::bytes() const {
  return points_.size() * sizeof(Point) + kappas_.size() * sizeof(float) + cells_.bytes();
}

}  // namespace evenglow::tracer

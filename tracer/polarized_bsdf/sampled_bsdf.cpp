#include "tracer/polarized_bsdf/sampled_bsdf.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/math/select.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"

namespace evenglow::tracer {
namespace {

constexpr double kInt16 = 1.0 / 32767.0;
constexpr double kUint16 = 1.0 / 65535.0;

/// Parts of an interval of phi' on which the bounds of the proposals are taken, and room for their rounding.
constexpr std::size_t kParts = 8;
constexpr double kSlack = 1.0 + 1e-6;

/// cos and sin of an angle within 0.175 rad of 0, to 1e-13 and 4e-13.
void small_sincos(double a, double& cosine, double& sine) {
  const double a2 = a * a;
  cosine = 1.0 + a2 * (-1.0 / 2 + a2 * (1.0 / 24 + a2 * (-1.0 / 720 + a2 / 40320)));
  sine = a * (1.0 + a2 * (-1.0 / 6 + a2 * (1.0 / 120 + a2 * (-1.0 / 5040 + a2 / 362880))));
}

/// Root of a value that is not negative, in units of `unit` (0: the value is 0).
std::uint16_t packed_root(double value, double unit) {
  return unit > 0.0 ? static_cast<std::uint16_t>(std::lround(std::sqrt(std::max(value, 0.0)) / unit)) : 0;
}

}  // namespace

SampledBsdf::SampledBsdf(const BsdfTable& table, double wavelength_nm, const HemisphericalTable* hemispherical,
                         double pass_index) {
  for (std::size_t r = 0; r < kRows; ++r) {
    const double phi = 2.0 * core::kPi * (static_cast<double>(r) + 0.5) / static_cast<double>(kRows);
    cos_row_[r] = std::cos(phi);
    sin_row_[r] = std::sin(phi);
  }
  for (std::size_t c = 0; c < u4_.size(); ++c) u4_[c] = std::pow(static_cast<double>(c * kBlock), 4);
  find_distances();
  Resampler resampler(table, wavelength_nm, hemispherical, pass_index, ResamplingShape{kU, kPhi});
  points_.reserve(grid_.size() * kKinds * kPoints);
  for (std::size_t node = 0; node < grid_.size(); ++node) {
    const ResampledNode resampled = resampler.node(grid_.psi(node), grid_.sigma(node));
    for (const auto& kind : resampled.kinds) {
      add_points(kind, resampled.weights);
      if (!resampler.has_kappa()) continue;
      for (const ResampledPoint& p : kind) kappas_.push_back(static_cast<float>(p.kappa));
    }
    add_integrals(node, resampled.weights);
    add_proposals(node);
  }
  remarks_ = resampler.remarks();
}

/// Packs the points of one node and kind along the axis of their integral.
void SampledBsdf::add_points(const std::vector<ResampledPoint>& points, const std::vector<double>& weights) {
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x += weights[i] * points[i].S * points[i].x;
    y += weights[i] * points[i].S * points[i].y;
  }
  Axis axis;
  const double length = std::hypot(x, y);
  if (length > 0.0) {
    axis.x = x / length;
    axis.y = y / length;
  }
  const auto along = [&](const ResampledPoint& p) { return std::clamp(p.x * axis.x + p.y * axis.y, -1.0, 1.0); };
  for (const ResampledPoint& p : points) {
    axis.unit_a = std::max(axis.unit_a, 0.5 * p.S * (1.0 - along(p)));
    axis.unit_b = std::max(axis.unit_b, 0.5 * p.S * (1.0 + along(p)));
  }
  axis.unit_a = std::sqrt(axis.unit_a) * kUint16;
  axis.unit_b = std::sqrt(axis.unit_b) * kUint16;
  scale(axis, 1.0);
  for (const ResampledPoint& p : points) {
    const Point packed{packed_root(0.5 * p.S * (1.0 - along(p)), axis.unit_a),
                       packed_root(0.5 * p.S * (1.0 + along(p)), axis.unit_b), 0};
    const double most = 2.0 * packed.root_a * axis.unit_a * packed.root_b * axis.unit_b;
    const double across = p.S * (p.y * axis.x - p.x * axis.y);
    points_.push_back(packed);
    if (most > 0.0) points_.back().y = static_cast<std::int16_t>(std::clamp(across / most, -1.0, 1.0) / kInt16);
  }
  axes_.push_back(axis);
}

/// Multiplies all values of the points by `factor`.
void SampledBsdf::scale(Axis& axis, double factor) {
  axis.unit_a *= std::sqrt(factor);
  axis.unit_b *= std::sqrt(factor);
  axis.square_a = axis.unit_a * axis.unit_a;
  axis.square_b = axis.unit_b * axis.unit_b;
  axis.product = 2.0 * kInt16 * axis.unit_a * axis.unit_b;
}

/// From the numbers as stored, so that they are those of what is drawn.
void SampledBsdf::add_integrals(std::size_t node, const std::vector<double>& weights) {
  std::array<Response, kKinds> integral{};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    Lobes sum;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Lobes lobes = value(index(node, kind), i);
      sum.a += weights[i] * lobes.a;
      sum.b += weights[i] * lobes.b;
      sum.y += weights[i] * lobes.y;
    }
    integral[kind] = turned(sum, index(node, kind));
  }
  // Rounding must not make a film that loses nothing into one that gives.
  const double most =
      0.5 * (integral[0].S + integral[1].S + std::hypot(integral[0].x + integral[1].x, integral[0].y + integral[1].y));
  if (most > 1.0) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      scale(axes_[index(node, kind)], 1.0 / most);
      integral[kind] = {integral[kind].S / most, integral[kind].x / most, integral[kind].y / most};
    }
  }
  integrals_.push_back(integral);
  totals_.push_back({integral[0].S + integral[1].S, integral[0].x + integral[1].x, integral[0].y + integral[1].y});
}

/// Squares of r on the borders of the parts of each interval of phi', where r is monotone: the grid lines hold 0 and
/// 180 degrees.
void SampledBsdf::find_distances() {
  for (const double sigma : grid_.sigmas()) {
    const double cosine = std::cos(sigma);
    std::vector<double> squares;
    for (std::size_t k = 0; k <= kPhi * kParts; ++k) {
      const double phi = 2.0 * core::kPi * static_cast<double>(k) / static_cast<double>(kPhi * kParts);
      squares.push_back(std::pow(horizon_distance(std::sin(sigma), cosine * cosine, std::cos(phi), std::sin(phi)), 2));
    }
    squared_distances_.push_back(std::move(squares));
  }
}

/// Bounds of (A + |Y| / 2) r^2 and (B + |Y| / 2) r^2 in a block. Both factors are bounded on parts of each interval of
/// phi', since near grazing r and the lobes change much in it, and against each other.
std::array<double, 2> SampledBsdf::bounds(std::size_t index, std::size_t row, std::size_t column) const {
  const std::vector<double>& squares = squared_distances_[grid_.sigma_index(index / kKinds)];
  std::array<double, 2> most{};
  for (std::size_t iphi = row * kBlock; iphi < (row + 1) * kBlock; ++iphi) {
    for (std::size_t iu = column * kBlock; iu <= (column + 1) * kBlock; ++iu) {
      const Lobes here = value(index, iphi * kRing + iu);
      const Lobes next = value(index, (iphi + 1) % kPhi * kRing + iu);
      const std::array<double, 2> first{here.a + 0.5 * std::abs(here.y), here.b + 0.5 * std::abs(here.y)};
      const std::array<double, 2> last{next.a + 0.5 * std::abs(next.y), next.b + 0.5 * std::abs(next.y)};
      for (std::size_t part = 0; part < kParts; ++part) {
        const double t0 = static_cast<double>(part) / kParts, t1 = static_cast<double>(part + 1) / kParts;
        const double r2 = std::max(squares[iphi * kParts + part], squares[iphi * kParts + part + 1]);
        for (std::size_t lobe = 0; lobe < 2; ++lobe) {
          const double at0 = first[lobe] + t0 * (last[lobe] - first[lobe]);
          const double at1 = first[lobe] + t1 * (last[lobe] - first[lobe]);
          most[lobe] = std::max(most[lobe], std::max(at0, at1) * r2);
        }
      }
    }
  }
  return most;
}

/// Proposals for each lobe, A + |Y| / 2 and B + |Y| / 2: a block with the odds of its bound x integral of 4 u^3; in it
/// u^4 and phi' are uniform.
void SampledBsdf::add_proposals(std::size_t node) {
  std::array<std::vector<double>, 2> weights;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    for (auto& w : weights) w.clear();
    for (std::size_t row = 0; row < kRows; ++row) {
      for (std::size_t column = 0; column < LobeProposals::kColumns; ++column) {
        const std::array<double, 2> bound = bounds(index(node, kind), row, column);
        const double measure = kSlack * (u4_[column + 1] - u4_[column]);
        weights[0].push_back(bound[0] * measure);
        weights[1].push_back(bound[1] * measure);
      }
    }
    Axis& axis = axes_[index(node, kind)];
    proposals_.add(weights[0]);
    proposals_.add(weights[1]);
    axis.total_a = proposals_.total(2 * index(node, kind));
    axis.total_b = proposals_.total(2 * index(node, kind) + 1);
  }
}

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
  const double sphi = phi * (static_cast<double>(kPhi) / (2.0 * core::kPi));
  const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
  const std::size_t iphi = std::min(static_cast<std::size_t>(sphi), kPhi - 1);
  const double tu = su - static_cast<double>(iu);
  const double tphi = sphi - static_cast<double>(iphi);
  const std::size_t i = index(node, static_cast<std::size_t>(kind));
  const double distance = horizon_distance(grid_.sin_sigma(node), grid_.cos2_sigma(node), cos_phi, sin_phi);
  Response r = turned(bilinear(i, iu, iphi, tu, tphi), i);
  const double r2 = distance * distance;
  return {r.S * r2, r.x * r2, r.y * r2, kappa(i, iu, iphi, tu, tphi)};
}

SampledBsdf::Draw SampledBsdf::draw(std::size_t node, double q1, double q2, core::PhotonRng& rng) const {
  constexpr double kStep = 2.0 * core::kPi / static_cast<double>(kRows);
  const double sin_in = grid_.sin_sigma(node);
  const double cos2_in = grid_.cos2_sigma(node);
  // Shares of the two lobes of each kind, and their proposals' sums.
  std::array<double, kKinds> along{}, across{};
  std::array<double, kLobes> odds{};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const Axis& axis = axes_[index(node, kind)];
    along[kind] = std::clamp(axis.x * q1 + axis.y * q2, -1.0, 1.0);
    across[kind] = axis.x * q2 - axis.y * q1;
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
        proposals_.draw(kLobes * node + lobe, std::min((at - before[lobe]) / odds[lobe], kBelowOne));
    const double low4 = u4_[block.column];
    const double span4 = u4_[block.column + 1] - low4;
    const double su = std::sqrt(std::sqrt(low4 + span4 * rng.uniform()));
    const double turn = rng.uniform();

    const std::size_t iu = std::min(static_cast<std::size_t>(su), kU - 1);
    const double sphi = turn * static_cast<double>(kBlock);
    const auto part = static_cast<std::size_t>(sphi);
    const std::size_t kind = lobe / 2;
    const std::size_t i = index(node, kind);
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
      Draw d{static_cast<ScatterKind>(kind), su * (1.0 / static_cast<double>(kU)), cos_phi, sin_phi, turned(lobes, i)};
      d.response.kappa = kappa(i, iu, block.row * kBlock + part, tu, tphi);
      return d;
    }
  }
}

std::size_t SampledBsdf::bytes() const {
  return points_.size() * sizeof(Point) + kappas_.size() * sizeof(float) + proposals_.bytes();
}

}  // namespace evenglow::tracer

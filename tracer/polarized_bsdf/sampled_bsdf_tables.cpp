#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/outgoing_polar.h"
#include "tracer/polarized_bsdf/sampled_bsdf.h"

/// How the tables of a `SampledBsdf` are made; what is drawn from them stands in sampled_bsdf.cpp.
namespace evenglow::tracer {
namespace {

constexpr double kUint16 = 1.0 / 65535.0;

/// Parts of an interval of phi' on which the bounds of the proposals are taken, and room for their rounding.
constexpr std::size_t kParts = 8;
constexpr double kSlack = 1.0 + 1e-6;

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
  for (std::size_t node = 0; node < grid_.size(); ++node) {
    add_node(node, resampler.node(grid_.psi(node), grid_.sigma(node)), resampler.has_kappa());
  }
  points_.shrink_to_fit();
  remarks_ = resampler.remarks();
}

/// Its tables, or a reference to those of which it is the mirror image.
void SampledBsdf::add_node(std::size_t node, const ResampledNode& resampled, bool with_kappa) {
  std::array<Packed, kKinds> kinds{packed(resampled.kinds[0], resampled.weights),
                                   packed(resampled.kinds[1], resampled.weights)};
  const std::size_t twin = grid_.mirrored(node);
  if (twin < node && mirrors(kinds, resampled, held_[twin].place)) {
    held_.push_back({held_[twin].place, -1.0});
    auto integral = integrals_[twin];
    for (Response& r : integral) r.y = -r.y;
    integrals_.push_back(integral);
    totals_.push_back({totals_[twin].S, totals_[twin].x, -totals_[twin].y});
    return;
  }
  const std::size_t place = sigmas_.size();
  held_.push_back({place, 1.0});
  sigmas_.push_back(grid_.sigma_index(node));
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    axes_.push_back(kinds[kind].axis);
    points_.insert(points_.end(), kinds[kind].points.begin(), kinds[kind].points.end());
    if (!with_kappa) continue;
    for (const ResampledPoint& p : resampled.kinds[kind]) kappas_.push_back(static_cast<float>(p.kappa));
  }
  add_integrals(place, resampled.weights);
  add_proposals(place);
}

/// Are these tables those held at `place`, mirrored, but for the rounding of the last stored digit?
bool SampledBsdf::mirrors(const std::array<Packed, kKinds>& kinds, const ResampledNode& node, std::size_t place) const {
  constexpr double kRounding = 1e-9;
  constexpr double kKappaRounding = 1e-6;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const std::size_t i = index(place, kind);
    const Axis& here = kinds[kind].axis;
    const Axis& there = axes_[i];
    // The other's units may have been scaled down by what rounding had added (`add_integrals`).
    const auto same = [](double a, double b) { return std::abs(a - b) <= kUint16 * std::abs(b); };
    if (std::abs(here.x - there.x) > kRounding || std::abs(here.y + there.y) > kRounding) return false;
    if (!same(here.unit_a, there.unit_a) || !same(here.unit_b, there.unit_b)) return false;
    for (std::size_t phi = 0; phi < kPhi; ++phi) {
      for (std::size_t u = 0; u < kRing; ++u) {
        const std::size_t own = phi * kRing + u, other = (kPhi - phi) % kPhi * kRing + u;
        const Point& p = kinds[kind].points[own];
        const Point& q = points_[i * kPoints + other];
        if (std::abs(p.root_a - q.root_a) > 1 || std::abs(p.root_b - q.root_b) > 1) return false;
        if (p.root_a == q.root_a && p.root_b == q.root_b && std::abs(p.y + q.y) > 1) return false;
        if (kappas_.empty()) continue;
        if (std::abs(node.kinds[kind][own].kappa - static_cast<double>(kappas_[i * kPoints + other])) >
            kKappaRounding) {
          return false;
        }
      }
    }
  }
  return true;
}

/// The points of one node and kind along the axis of their integral.
SampledBsdf::Packed SampledBsdf::packed(const std::vector<ResampledPoint>& points, const std::vector<double>& weights) {
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x += weights[i] * points[i].S * points[i].x;
    y += weights[i] * points[i].S * points[i].y;
  }
  Packed result;
  Axis& axis = result.axis;
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
    Point point{packed_root(0.5 * p.S * (1.0 - along(p)), axis.unit_a),
                packed_root(0.5 * p.S * (1.0 + along(p)), axis.unit_b), 0};
    const double most = 2.0 * point.root_a * axis.unit_a * point.root_b * axis.unit_b;
    const double across = p.S * (p.y * axis.x - p.x * axis.y);
    if (most > 0.0) point.y = static_cast<std::int16_t>(std::clamp(across / most, -1.0, 1.0) / kInt16);
    result.points.push_back(point);
  }
  return result;
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
void SampledBsdf::add_integrals(std::size_t place, const std::vector<double>& weights) {
  std::array<Response, kKinds> integral{};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    Lobes sum;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const Lobes lobes = value(index(place, kind), i);
      sum.a += weights[i] * lobes.a;
      sum.b += weights[i] * lobes.b;
      sum.y += weights[i] * lobes.y;
    }
    integral[kind] = turned(sum, index(place, kind));
  }
  // Rounding must not make a film that loses nothing into one that gives.
  const double most =
      0.5 * (integral[0].S + integral[1].S + std::hypot(integral[0].x + integral[1].x, integral[0].y + integral[1].y));
  if (most > 1.0) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      scale(axes_[index(place, kind)], 1.0 / most);
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
  const std::vector<double>& squares = squared_distances_[sigmas_[index / kKinds]];
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
void SampledBsdf::add_proposals(std::size_t place) {
  std::array<std::vector<double>, 2> weights;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    for (auto& w : weights) w.clear();
    for (std::size_t row = 0; row < kRows; ++row) {
      for (std::size_t column = 0; column < LobeProposals::kColumns; ++column) {
        const std::array<double, 2> bound = bounds(index(place, kind), row, column);
        const double measure = kSlack * (u4_[column + 1] - u4_[column]);
        weights[0].push_back(bound[0] * measure);
        weights[1].push_back(bound[1] * measure);
      }
    }
    Axis& axis = axes_[index(place, kind)];
    proposals_.add(weights[0]);
    proposals_.add(weights[1]);
    axis.total_a = proposals_.total(2 * index(place, kind));
    axis.total_b = proposals_.total(2 * index(place, kind) + 1);
  }
}

}  // namespace evenglow::tracer

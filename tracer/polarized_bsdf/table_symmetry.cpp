#include "tracer/polarized_bsdf/table_symmetry.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

/// Incidence and observation in the angles of the table, rad.
struct Path {
  double psi = 0.0, sigma = 0.0, phi = 0.0, theta = 0.0;
};

/// S that a table of zeros comes out with: its logarithm has a floor (`BsdfTable`), here with room for rounding.
constexpr double kNegligible = 2e-12;  ///< of the largest S
constexpr double kLeast = 2e-30;       ///< 1/sr

struct Vector {
  double x, y, z;
};

/// Outgoing direction with z made positive (specular and direct axis are mirror images), plane of incidence xz.
Vector outgoing(const Path& path) {
  const double s = std::sin(path.sigma), c = std::cos(path.sigma);
  const double a = std::cos(path.theta);
  const double u = std::sin(path.theta) * std::cos(path.phi);
  return {a * s + u * c, std::sin(path.theta) * std::sin(path.phi), a * c - u * s};
}

/// The reversed path, turned by half a turn about the normal: incident along the outgoing tangential direction.
Path reversed(const Path& path, const Vector& out) {
  const double azimuth = std::atan2(out.y, out.x);
  const double sigma = std::atan2(std::hypot(out.x, out.y), out.z);
  // The old direction of incidence seen in the new plane of incidence.
  const double x = std::sin(path.sigma) * std::cos(azimuth);
  const double y = -std::sin(path.sigma) * std::sin(azimuth);
  const double z = std::cos(path.sigma);
  const double s = std::sin(sigma), c = std::cos(sigma);
  const double in_plane = c * x - s * z;
  return {path.psi - azimuth, sigma, std::atan2(y, in_plane), std::atan2(std::hypot(in_plane, y), s * x + c * z)};
}

using Partner = std::function<std::optional<Path>(const Path&, const Vector& out)>;

Agreement agreement(const BsdfTable& table, ScatterKind kind, const Partner& partner) {
  const BsdfTable::Axes& a = table.axes();
  Agreement result;
  double difference = 0.0, sum = 0.0, worst = 0.0;
  const double zero = std::max(kNegligible * table.largest(), kLeast);
  for (std::size_t l = 0; l < a.lambda_nm.size(); ++l) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 0; t < a.theta.size(); ++t) {
            const Path path{a.psi[p], a.sigma[s], a.phi[f], a.theta[t]};
            const Vector out = outgoing(path);
            if (out.z <= 0.0) continue;
            const auto other = partner(path, out);
            if (!other) continue;
            const BsdfTable::Node& node = table.node(kind, p, s, f, t, l);
            const double here = node.tau_min + node.tau_max;
            const double there = table.at(kind, other->psi, other->sigma, other->phi, other->theta, a.lambda_nm[l]).S;
            if (here <= zero && there <= zero) continue;  // dark both ways: no ratio to speak of
            const double weight = std::cos(path.sigma) * out.z;
            difference += weight * std::abs(here - there);
            sum += weight * 0.5 * (here + there);
            ++result.pairs;
            const double log_ratio = here > 0.0 && there > 0.0 ? std::abs(std::log(here / there)) : 0.0;
            if (log_ratio <= worst) continue;
            worst = log_ratio;
            result.worst = {p, s, f, t, l, here / there};
          }
        }
      }
    }
  }
  if (sum > 0.0) result.mean_difference = difference / sum;
  return result;
}

}  // namespace

Agreement reciprocity(const BsdfTable& table, ScatterKind kind) {
  constexpr double kRounding = 1e-9;
  const double last = table.axes().sigma.back();
  return agreement(table, kind, [last](const Path& path, const Vector& out) -> std::optional<Path> {
    const Path other = reversed(path, out);
    if (other.sigma > last + kRounding) return std::nullopt;
    return other;
  });
}

Agreement mirror_symmetry(const BsdfTable& table, ScatterKind kind) {
  return agreement(table, kind, [](const Path& path, const Vector&) -> std::optional<Path> {
    return Path{-path.psi, path.sigma, -path.phi, path.theta};
  });
}

}  // namespace evenglow::tracer

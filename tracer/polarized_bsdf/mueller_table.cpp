#include "tracer/polarized_bsdf/mueller_table.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tracer/polarized_bsdf/bracket.h"
#include "tracer/polarized_bsdf/mueller_columns.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::tracer {
namespace {

std::vector<double> radians(std::vector<double> degrees) {
  for (double& value : degrees) value *= core::kRadPerDeg;
  return degrees;
}

BsdfTable::Axes axes_in_rad(const StoredTable& table) {
  return {radians(table.axes[0]), radians(table.axes[1]), radians(table.axes[2]), radians(table.axes[3]),
          table.axes[4]};
}

/// What the comment says about the frames (`mueller_text`).
AngleOrigin frames_of(const StoredTable& table) {
  return table.comment.find("frames e1, e2") == std::string::npos ? AngleOrigin::film : AngleOrigin::laboratory;
}

/// M / m00, physical to rounding: (1 - e) M + e diag(m00, 0, 0, 0) has the eigenvalues (1 - e) h + e / 4 (trace 1).
core::MuellerMatrix physical_share(const core::MuellerMatrix& M) {
  core::MuellerMatrix depolarizer = core::MuellerMatrix::Zero();
  depolarizer(0, 0) = 1.0;
  if (M(0, 0) <= 0.0) return depolarizer;
  core::MuellerMatrix share = M / M(0, 0);
  const double least = core::least_coherency_eigenvalue(share);
  if (least >= 0.0) return share;
  const double e = -least / (0.25 - least);
  return (1.0 - e) * share + e * depolarizer;
}

/// Nodes of `BsdfTable::from_nodes` order (lambda, psi, sigma, theta, phi), each with its index in the stored values.
template <typename Visit>
void for_each_node(const StoredTable& table, Visit&& visit) {
  const auto& [psi, sigma, phi, theta, lambda] = table.axes;
  for (std::size_t k = 0; k < table.kinds.size(); ++k) {
    for (std::size_t l = 0; l < lambda.size(); ++l) {
      for (std::size_t p = 0; p < psi.size(); ++p) {
        for (std::size_t s = 0; s < sigma.size(); ++s) {
          for (std::size_t t = 0; t < theta.size(); ++t) {
            for (std::size_t f = 0; f < phi.size(); ++f) {
              const std::size_t incidence = (k * psi.size() + p) * sigma.size() + s;
              const std::size_t stored = ((incidence * phi.size() + f) * theta.size() + t) * lambda.size() + l;
              visit(table.kinds[k], stored, psi[p], sigma[s], phi[f], theta[t]);
            }
          }
        }
      }
    }
  }
}

std::array<std::vector<core::MuellerMatrix>, 2> film_matrices(const StoredTable& table, AngleOrigin frames) {
  if (table.form != StoredForm::mueller) {
    throw core::ConfigError(
        core::Fault{table.name, 0, 0, {}, "must hold Mueller matrices (m00 ... m33), got tau_min, tau_max, delta"});
  }
  std::array<std::vector<core::MuellerMatrix>, 2> matrices;
  for_each_node(table, [&](std::size_t kind, std::size_t stored, double psi, double sigma, double phi, double theta) {
    core::MuellerMatrix M;
    for (std::size_t e = 0; e < 16; ++e) M(static_cast<int>(e / 4), static_cast<int>(e % 4)) = table.values[e][stored];
    if (frames == AngleOrigin::laboratory) {
      constexpr double kRad = core::kRadPerDeg;
      M = core::rotator(outgoing_psi(psi * kRad, sigma * kRad, phi * kRad, theta * kRad)) * M *
          core::rotator(-psi * kRad);
    }
    matrices[kind].push_back(M);
  });
  return matrices;
}

std::array<std::vector<BsdfTable::Node>, 2> first_rows(
    const std::array<std::vector<core::MuellerMatrix>, 2>& matrices) {
  std::array<std::vector<BsdfTable::Node>, 2> nodes;
  for (std::size_t kind = 0; kind < 2; ++kind) {
    for (const core::MuellerMatrix& M : matrices[kind]) {
      const double I = std::max(0.0, M(0, 0));
      const double D = std::min(I, std::hypot(M(0, 1), M(0, 2)));
      nodes[kind].push_back({I - D, I + D, 0.5 * std::atan2(-M(0, 2), -M(0, 1))});
    }
  }
  return nodes;
}

}  // namespace

double outgoing_psi(double psi, double sigma, double phi, double theta) {
  const double x = std::cos(theta) * std::sin(sigma) + std::sin(theta) * std::cos(phi) * std::cos(sigma);
  const double y = std::sin(theta) * std::sin(phi);
  return std::hypot(x, y) > 1e-12 ? psi - std::atan2(y, x) : psi;
}

MuellerTable::MuellerTable(const StoredTable& table, std::optional<AngleOrigin> frames)
    : MuellerTable(table, frames.value_or(frames_of(table)), axes_in_rad(table),
                   film_matrices(table, frames.value_or(frames_of(table)))) {}

MuellerTable::MuellerTable(const StoredTable& table, AngleOrigin frames, BsdfTable::Axes axes, Matrices matrices)
    : frames_(frames),
      intensities_(BsdfTable::from_nodes(table.name, std::move(axes), first_rows(matrices))),
      shares_(std::move(matrices)),
      psi_(intensities_.axes().psi, core::kPi),
      phi_(intensities_.axes().phi, 2.0 * core::kPi) {
  for (auto& kind : shares_) {
    for (core::MuellerMatrix& M : kind) M = physical_share(M);
  }
}

MuellerTable MuellerTable::read(const std::filesystem::path& file, std::optional<AngleOrigin> frames) {
  return MuellerTable(parse_stored_table(read_table_bytes(file), file.string()), frames);
}

MuellerTable::Slice MuellerTable::slice(ScatterKind kind, double psi, double sigma, double lambda_nm) const {
  Slice slice;
  slice.table_ = this;
  slice.intensities_ = intensities_.slice(kind, psi, sigma, lambda_nm);
  const BsdfTable::Axes& a = axes();
  const Bracket s = sigma_bracket(a.sigma, sigma);
  const Bracket l = lambda_bracket(a.lambda_nm, lambda_nm);
  const std::vector<double> linear = psi_.linear_weights(psi);
  const std::size_t count = a.phi.size() * a.theta.size();
  slice.shares_.assign(count, core::MuellerMatrix::Zero());
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double weight = (corner & 1 ? s.t : 1.0 - s.t) * (corner & 2 ? l.t : 1.0 - l.t);
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      if (weight * linear[p] == 0.0) continue;
      const std::size_t base =
          (((corner & 2 ? l.j : l.i) * a.psi.size() + p) * a.sigma.size() + (corner & 1 ? s.j : s.i)) * count;
      const core::MuellerMatrix* share = &shares_[static_cast<std::size_t>(kind)][base];
      for (std::size_t c = 0; c < count; ++c) slice.shares_[c] += weight * linear[p] * share[c];
    }
  }
  return slice;
}

core::MuellerMatrix MuellerTable::Slice::at(double phi, double theta) const {
  const std::size_t n_phi = table_->axes().phi.size();
  const PeriodicSpline::Place p = table_->phi_.place(phi);
  const Bracket t = theta_bracket(table_->axes().theta, theta);
  core::MuellerMatrix share = core::MuellerMatrix::Zero();
  for (const auto& [row, weight] : {std::pair{t.i, 1.0 - t.t}, std::pair{t.j, t.t}}) {
    if (weight == 0.0) continue;
    share += weight * (p.a * shares_[row * n_phi + p.i] + p.b * shares_[row * n_phi + p.j]);
  }
  return 0.5 * intensities_.at(phi, theta).S * share;
}

}  // namespace evenglow::tracer

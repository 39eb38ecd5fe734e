#include "tracer/polarized_bsdf/bsdf_table.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/config/csv_numbers.h"
#include "tracer/polarized_bsdf/bracket.h"
#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "tracer/polarized_bsdf/csv_units.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::tracer {
namespace {

/// Least S, as a share of the table's largest, whose logarithm is taken: a node of zero must not pull its neighbors
/// down to nothing.
constexpr double kSmallestShare = 1e-12;

std::vector<double> radians(std::vector<double> degrees) {
  for (double& value : degrees) value *= core::kRadPerDeg;
  return degrees;
}

}  // namespace

BsdfTable BsdfTable::read(const std::filesystem::path& file) {
  const std::string bytes = read_table_bytes(file);
  if (names_hdf5(file)) return from_stored(parse_stored_table(bytes, file.string()));
  return parse(bytes, file.string());
}

BsdfTable BsdfTable::parse(std::string_view text, std::string name) {
  if (const auto fault = unit_fault(text, name, false)) throw core::ConfigError(*fault);
  return BsdfTable(core::CsvNumbers::parse(text, std::move(name), bsdf_columns(), bsdf_row_fault));
}

BsdfTable BsdfTable::from_stored(const StoredTable& table) {
  if (table.form != StoredForm::diattenuator) {
    throw core::ConfigError(core::Fault{table.name,
                                        0,
                                        0,
                                        {},
                                        "must hold tau_min, tau_max and delta, got Mueller matrices (film kind "
                                        "mueller_table)"});
  }
  return BsdfTable(table.rows());
}

BsdfTable::BsdfTable(const core::CsvNumbers& numbers)
    : name_(numbers.name()), psi_spline_({0.0}, core::kPi), phi_spline_({0.0}, 2.0 * core::kPi) {
  const BsdfGrid grid = sort_to_grid(numbers);
  axes_ = {radians(grid.psi), radians(grid.sigma), radians(grid.phi), radians(grid.theta), grid.lambda_nm};
  psi_spline_ = PeriodicSpline(axes_.psi, core::kPi);
  phi_spline_ = PeriodicSpline(axes_.phi, 2.0 * core::kPi);
  const auto optional = [&](std::size_t row, std::size_t column, double otherwise) {
    return numbers.has(column) ? numbers.value(row, column) : otherwise;
  };
  const std::size_t count = grid.order.size() / grid.kinds.size();
  for (std::size_t k = 0; k < grid.kinds.size(); ++k) {
    std::vector<Node>& nodes = nodes_[grid.kinds[k]];
    nodes.reserve(count);
    for (std::size_t i = k * count; i < (k + 1) * count; ++i) {
      const std::size_t row = grid.order[i];
      nodes.push_back({numbers.value(row, kTauMin), numbers.value(row, kTauMax),
                       numbers.value(row, kDelta) * core::kRadPerDeg, optional(row, kKappa, 1.0),
                       optional(row, kTauMinSe, 0.0), optional(row, kTauMaxSe, 0.0),
                       optional(row, kDeltaSe, 0.0) * core::kRadPerDeg});
    }
  }
  prepare_logs();
}

BsdfTable BsdfTable::from_nodes(std::string name, Axes axes, std::array<std::vector<Node>, 2> nodes) {
  return BsdfTable(std::move(name), std::move(axes), std::move(nodes));
}

BsdfTable::BsdfTable(std::string name, Axes axes, std::array<std::vector<Node>, 2> nodes)
    : name_(std::move(name)),
      axes_(std::move(axes)),
      psi_spline_(axes_.psi, core::kPi),
      phi_spline_(axes_.phi, 2.0 * core::kPi),
      nodes_(std::move(nodes)) {
  const std::size_t count =
      axes_.psi.size() * axes_.sigma.size() * axes_.phi.size() * axes_.theta.size() * axes_.lambda_nm.size();
  for (const auto& kind : nodes_) {
    core::expects(kind.empty() || kind.size() == count, "a table holds a row for every node of its grid");
  }
  prepare_logs();
}

void BsdfTable::prepare_logs() {
  const double smallest = std::max(largest() * kSmallestShare, 1e-30);
  for (std::size_t kind = 0; kind < 2; ++kind) {
    for (const Node& node : nodes_[kind]) {
      const double S = node.tau_min + node.tau_max;
      const double share = S > 0.0 ? (node.tau_max - node.tau_min) / S : 0.0;
      logs_[kind].push_back(
          {std::log(std::max(S, smallest)), share * std::cos(2.0 * node.delta), share * std::sin(2.0 * node.delta)});
    }
  }
}

double BsdfTable::largest() const {
  double largest = 0.0;
  for (const auto& nodes : nodes_) {
    for (const Node& node : nodes) largest = std::max(largest, node.tau_min + node.tau_max);
  }
  return largest;
}

double BsdfTable::least_kappa() const {
  double least = 1.0;
  for (const auto& nodes : nodes_) {
    for (const Node& node : nodes) least = std::min(least, node.kappa);
  }
  return least;
}

std::size_t BsdfTable::index(std::size_t psi, std::size_t sigma, std::size_t phi, std::size_t theta,
                             std::size_t lambda) const {
  const std::size_t incidence = (lambda * axes_.psi.size() + psi) * axes_.sigma.size() + sigma;
  return (incidence * axes_.theta.size() + theta) * axes_.phi.size() + phi;
}

const BsdfTable::Node& BsdfTable::node(ScatterKind kind, std::size_t psi, std::size_t sigma, std::size_t phi,
                                       std::size_t theta, std::size_t lambda) const {
  return nodes_[static_cast<std::size_t>(kind)].at(index(psi, sigma, phi, theta, lambda));
}

BsdfTable::Value BsdfTable::at(ScatterKind kind, double psi, double sigma, double phi, double theta,
                               double lambda_nm) const {
  return has(kind) ? slice(kind, psi, sigma, lambda_nm).at(phi, theta) : Value{};
}

BsdfTable::Slice BsdfTable::slice(ScatterKind kind, double psi, double sigma, double lambda_nm) const {
  core::expects(has(kind), "a slice is of a kind that the table holds");
  const auto& logs = logs_[static_cast<std::size_t>(kind)];
  const auto& nodes = nodes_[static_cast<std::size_t>(kind)];
  const Bracket s = sigma_bracket(axes_.sigma, sigma);
  const Bracket l = lambda_bracket(axes_.lambda_nm, lambda_nm);
  const std::vector<double> cubic = psi_spline_.weights(psi);
  const std::vector<double> linear = psi_spline_.linear_weights(psi);
  const std::size_t n_phi = axes_.phi.size();
  const std::size_t count = n_phi * axes_.theta.size();
  Slice slice;
  slice.table_ = this;
  slice.cells_.resize(count);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double weight = (corner & 1 ? s.t : 1.0 - s.t) * (corner & 2 ? l.t : 1.0 - l.t);
    if (weight == 0.0) continue;
    for (std::size_t p = 0; p < axes_.psi.size(); ++p) {
      const std::size_t base = index(p, corner & 1 ? s.j : s.i, 0, 0, corner & 2 ? l.j : l.i);
      for (std::size_t c = 0; c < count; ++c) {
        slice.cells_[c].log_S += weight * cubic[p] * logs[base + c].log_S;
        slice.cells_[c].x += weight * linear[p] * logs[base + c].x;
        slice.cells_[c].y += weight * linear[p] * logs[base + c].y;
        slice.cells_[c].kappa += weight * linear[p] * nodes[base + c].kappa;
      }
    }
  }
  std::vector<double> ring(n_phi);
  for (std::size_t t = 0; t < axes_.theta.size(); ++t) {
    for (std::size_t p = 0; p < n_phi; ++p) ring[p] = slice.cells_[t * n_phi + p].log_S;
    const std::vector<double> curvature = phi_spline_.second_derivatives(ring);
    for (std::size_t p = 0; p < n_phi; ++p) slice.cells_[t * n_phi + p].log_S_curvature = curvature[p];
  }
  return slice;
}

BsdfTable::Value BsdfTable::Slice::at(double phi, double theta) const {
  const std::vector<double>& nodes = table_->axes_.theta;
  const std::size_t n_phi = table_->axes_.phi.size();
  const PeriodicSpline::Place p = table_->phi_spline_.place(phi);
  const auto log_of_sum = [&](std::size_t t) {
    const Cell& i = cells_[t * n_phi + p.i];
    const Cell& j = cells_[t * n_phi + p.j];
    return p.a * i.log_S + p.b * j.log_S + p.c * i.log_S_curvature + p.d * j.log_S_curvature;
  };
  const Bracket t = theta_bracket(nodes, theta);
  double value = log_of_sum(t.i);
  if (t.j > t.i) {
    value += t.t * (log_of_sum(t.j) - value);
  } else if (theta > nodes.back() && nodes.size() > 1) {
    const std::size_t last = nodes.size() - 1;
    const double slope = (value - log_of_sum(last - 1)) / (nodes[last] - nodes[last - 1]);
    value += std::min(0.0, slope) * (theta - nodes[last]);
  }
  Value result{std::exp(value), 0.0, 0.0, 0.0};
  for (const auto& [row, share] : {std::pair{t.i, 1.0 - t.t}, std::pair{t.j, t.t}}) {
    const Cell& i = cells_[row * n_phi + p.i];
    const Cell& j = cells_[row * n_phi + p.j];
    result.x += share * (p.a * i.x + p.b * j.x);
    result.y += share * (p.a * i.y + p.b * j.y);
    result.kappa += share * (p.a * i.kappa + p.b * j.kappa);
  }
  return result;
}

}  // namespace evenglow::tracer

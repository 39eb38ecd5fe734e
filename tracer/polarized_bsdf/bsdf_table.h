#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/polarized_bsdf/periodic_spline.h"

namespace evenglow::core {
class CsvNumbers;
}  // namespace evenglow::core

namespace evenglow::tracer {

struct StoredTable;

enum class ScatterKind { reflection = 0, transmission = 1 };

/// Polarized BSDF of a film on a rectangular grid of angles: columns
/// `kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg` and optionally `tau_min_se`,
/// `tau_max_se`, `delta_se_deg`, `kappa`; the meaning of each, and the rule of interpolation, in
/// configs/data/README.md.
///
/// Rows may come in any order; every node of the grid must be there once, for each kind that is there at all.
/// Immutable, so any number of threads may read it.
class BsdfTable {
 public:
  /// Nodes, ascending. Angles in rad, psi within one turn of 180 degrees, phi within one of 360.
  struct Axes {
    std::vector<double> psi, sigma, phi, theta;
    std::vector<double> lambda_nm;
  };

  /// One row. tau in 1/sr, delta in rad; standard errors 0 and kappa 1 where the file has no such column.
  struct Node {
    double tau_min = 0.0, tau_max = 0.0, delta = 0.0;
    double kappa = 1.0;
    double tau_min_se = 0.0, tau_max_se = 0.0, delta_se = 0.0;
  };

  /// S = tau_min + tau_max (1/sr); (x, y) = (tau_max - tau_min) / S (cos 2 delta, sin 2 delta), length at most 1.
  struct Value {
    double S = 0.0, x = 0.0, y = 0.0;
    double kappa = 1.0;
  };

  /// The outgoing directions of one incidence.
  class Slice {
   public:
    /// `phi` any angle, `theta` >= 0 (rad), counted from the specular or the direct axis. Beyond the last theta, ln S
    /// goes on with the slope of the last interval, but never upwards.
    Value at(double phi, double theta) const;

   private:
    friend class BsdfTable;
    struct Cell {
      double log_S = 0.0, log_S_curvature = 0.0;  ///< curvature: second derivative against phi
      double x = 0.0, y = 0.0, kappa = 0.0;
    };
    const BsdfTable* table_ = nullptr;
    std::vector<Cell> cells_;  ///< index theta * n_phi + phi
  };

  /// Throw `core::ConfigError`: everything `core::CsvNumbers` (of a name that ends in .h5 or .hdf5: `parse_hdf5_table`)
  /// refuses, tau_min > tau_max, a repeated row, a missing node, Mueller matrices, a comment that names other units
  /// than degrees, nm and 1/sr (none at all is accepted).
  static BsdfTable read(const std::filesystem::path& file);
  static BsdfTable parse(std::string_view text, std::string name);
  static BsdfTable from_stored(const StoredTable& table);

  /// A table made in memory. `nodes`: by kind, an absent kind empty; index lambda slowest, then psi, sigma, theta, phi.
  static BsdfTable from_nodes(std::string name, Axes axes, std::array<std::vector<Node>, 2> nodes);

  const std::string& name() const { return name_; }
  const Axes& axes() const { return axes_; }
  double least_kappa() const;  ///< over all nodes
  double largest() const;      ///< S over all nodes, 1/sr
  bool has(ScatterKind kind) const { return !logs_[static_cast<std::size_t>(kind)].empty(); }
  /// The row at these indices into the axes. `kind` must be there.
  const Node& node(ScatterKind kind, std::size_t psi, std::size_t sigma, std::size_t phi, std::size_t theta,
                   std::size_t lambda) const;

  /// Interpolated: psi of period 180 degrees, sigma and lambda held beyond their last nodes. S = 0 for an absent kind.
  Value at(ScatterKind kind, double psi, double sigma, double phi, double theta, double lambda_nm) const;
  /// As `at`, for many directions of one incidence. The table must outlive it. `kind` must be there.
  Slice slice(ScatterKind kind, double psi, double sigma, double lambda_nm) const;

 private:
  struct Logs {  ///< what is interpolated, at one node
    double log_S = 0.0, x = 0.0, y = 0.0;
  };
  explicit BsdfTable(const core::CsvNumbers& numbers);
  BsdfTable(std::string name, Axes axes, std::array<std::vector<Node>, 2> nodes);
  std::size_t index(std::size_t psi, std::size_t sigma, std::size_t phi, std::size_t theta, std::size_t lambda) const;
  void prepare_logs();

  std::string name_;
  Axes axes_;
  PeriodicSpline psi_spline_;
  PeriodicSpline phi_spline_;
  std::array<std::vector<Node>, 2> nodes_;  ///< by kind; lambda slowest, then psi, sigma, theta, phi
  std::array<std::vector<Logs>, 2> logs_;
};

}  // namespace evenglow::tracer

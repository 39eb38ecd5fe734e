#include "tracer/polarized_bsdf/bsdf_grid.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

constexpr double kHuge = 1e12;
constexpr std::array<std::size_t, 6> kSortedBy{kKind, kLambda, kPsi, kSigma, kTheta, kPhi};

std::vector<double> distinct(const core::CsvNumbers& rows, std::size_t column) {
  std::vector<double> values(rows.rows());
  for (std::size_t r = 0; r < rows.rows(); ++r) values[r] = rows.value(r, column);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string described(const std::array<double, 6>& node) {
  return fmt::format("{} psi {} sigma {} phi {} theta {} lambda {}", node[0] == 0.0 ? "BRDF" : "BTDF", node[2], node[3],
                     node[5], node[4], node[1]);
}

/// Compares the sorted rows with an odometer over the axes: the first difference is a repeated or a missing node.
void require_complete(const core::CsvNumbers& rows, const std::vector<std::size_t>& order,
                      const std::array<std::vector<double>, 6>& axes) {
  std::array<std::size_t, 6> digit{};
  const auto refuse = [&](int line, std::string message) {
    throw core::ConfigError(core::Fault{rows.name(), line, line > 0 ? 1 : 0, {}, std::move(message)});
  };
  for (std::size_t r = 0;; ++r) {
    std::array<double, 6> expected{};
    for (std::size_t a = 0; a < 6; ++a) expected[a] = axes[a][digit[a]];
    const auto equals = [&](std::size_t row, const std::array<double, 6>& node) {
      return std::ranges::equal(kSortedBy, node, {}, [&](std::size_t c) { return rows.value(row, c); });
    };
    if (r > 0 && r < order.size()) {
      std::array<double, 6> before{};
      for (std::size_t a = 0; a < 6; ++a) before[a] = rows.value(order[r - 1], kSortedBy[a]);
      if (equals(order[r], before)) {
        refuse(rows.line(order[r]), fmt::format("must hold each node once, got {} again (first on line {})",
                                                described(before), rows.line(order[r - 1])));
      }
    }
    if (r == order.size() || !equals(order[r], expected)) {
      refuse(0, fmt::format("must hold every node of its grid, got none for {}", described(expected)));
    }
    std::size_t a = 6;
    while (a > 0 && ++digit[a - 1] == axes[a - 1].size()) digit[--a] = 0;
    if (a == 0) {
      // The grid is full; what is left can only repeat the last node.
      if (r + 1 < order.size()) {
        refuse(rows.line(order[r + 1]), fmt::format("must hold each node once, got {} again (first on line {})",
                                                    described(expected), rows.line(order[r])));
      }
      return;
    }
  }
}

}  // namespace

const std::vector<core::CsvColumn>& bsdf_columns() {
  static const std::vector<core::CsvColumn> table{
      {"kind", "BRDF or BTDF", 0, 0, false, true, {"BRDF", "BTDF"}},
      {"psi_deg", "a number in [0, 180)", 0, 180, true},
      {"sigma_deg", "a number in [0, 90)", 0, 90, true},
      {"phi_deg", "a number in [0, 360)", 0, 360, true},
      {"theta_deg", "a number in [0, 180)", 0, 180, true},
      {"lambda_nm", "a number in [100, 10000]", 100, 10000},
      {"tau_min", "a number in [0, 1e12]", 0, kHuge},
      {"tau_max", "a number in [0, 1e12]", 0, kHuge},
      {"delta_deg", "a number in [-360, 360]", -360, 360},
      {"tau_min_se", "a number in [0, 1e12]", 0, kHuge, false, false},
      {"tau_max_se", "a number in [0, 1e12]", 0, kHuge, false, false},
      {"delta_se_deg", "a number in [0, 1e12]", 0, kHuge, false, false},
      {"kappa", "a number in [0, 1]", 0, 1, false, false},
  };
  return table;
}

std::optional<std::pair<std::size_t, std::string>> bsdf_row_fault(std::span<const double> row) {
  if (row[kTauMin] <= row[kTauMax]) return std::nullopt;
  return std::pair{std::size_t{kTauMin},
                   fmt::format("must be at most tau_max = {}, got {}", row[kTauMax], row[kTauMin])};
}

BsdfGrid sort_to_grid(const core::CsvNumbers& rows) {
  std::array<std::vector<double>, 6> axes;
  for (std::size_t a = 0; a < 6; ++a) axes[a] = distinct(rows, kSortedBy[a]);
  BsdfGrid grid;
  grid.order.resize(rows.rows());
  std::iota(grid.order.begin(), grid.order.end(), std::size_t{0});
  std::ranges::stable_sort(grid.order, [&](std::size_t l, std::size_t r) {
    for (const std::size_t column : kSortedBy) {
      const double a = rows.value(l, column);
      const double b = rows.value(r, column);
      if (a != b) return a < b;
    }
    return false;
  });
  require_complete(rows, grid.order, axes);
  for (const double kind : axes[0]) grid.kinds.push_back(static_cast<std::size_t>(kind));
  grid.lambda_nm = std::move(axes[1]);
  grid.psi = std::move(axes[2]);
  grid.sigma = std::move(axes[3]);
  grid.theta = std::move(axes[4]);
  grid.phi = std::move(axes[5]);
  return grid;
}

}  // namespace evenglow::tracer

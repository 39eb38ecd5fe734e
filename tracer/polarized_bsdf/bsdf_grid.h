#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace evenglow::core {
class CsvNumbers;
struct CsvColumn;
}  // namespace evenglow::core

namespace evenglow::tracer {

/// Columns of a BSDF table, in the order of the indices below.
enum BsdfColumn : std::size_t {
  kKind,
  kPsi,
  kSigma,
  kPhi,
  kTheta,
  kLambda,
  kTauMin,
  kTauMax,
  kDelta,
  kTauMinSe,
  kTauMaxSe,
  kDeltaSe,
  kKappa
};

/// The columns with what each may hold, and what is wrong with a whole row (`core::CsvNumbers::RowCheck`).
const std::vector<core::CsvColumn>& bsdf_columns();
std::optional<std::pair<std::size_t, std::string>> bsdf_row_fault(std::span<const double> row);

/// Rows of a BSDF table sorted to its grid: kind slowest, then lambda, psi, sigma, theta, phi.
struct BsdfGrid {
  std::vector<std::size_t> kinds;                         ///< those that are there, ascending
  std::vector<double> lambda_nm, psi, sigma, theta, phi;  ///< nodes, ascending, in the units of the file
  std::vector<std::size_t> order;                         ///< row of each node
};

/// Throws `core::ConfigError`: a repeated row, a missing node (the first in the order above).
BsdfGrid sort_to_grid(const core::CsvNumbers& rows);

}  // namespace evenglow::tracer

#pragma once

#include <cstddef>
#include <vector>

namespace evenglow::tracer {

class CsvNumbers;

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

/// Rows of a BSDF table sorted to its grid: kind slowest, then lambda, psi, sigma, theta, phi.
struct BsdfGrid {
  std::vector<std::size_t> kinds;                         ///< those that are there, ascending
  std::vector<double> lambda_nm, psi, sigma, theta, phi;  ///< nodes, ascending, in the units of the file
  std::vector<std::size_t> order;                         ///< row of each node
};

/// Throws `core::ConfigError`: a repeated row, a missing node (the first in the order above).
BsdfGrid sort_to_grid(const CsvNumbers& rows);

}  // namespace evenglow::tracer

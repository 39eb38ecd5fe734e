#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace evenglow::core {
struct CsvColumn;
}  // namespace evenglow::core

namespace evenglow::tracer {

/// Columns of a table of Mueller matrices: the six of the node (`BsdfColumn` up to kLambda), the entries m00 ... m33,
/// their standard errors, what `mueller_text` tells of the fit.
inline constexpr std::size_t kFirstEntry = 6;  ///< m00; m_ij has the index kFirstEntry + 4 i + j

/// What a matrix of a file may miss to be physical: least eigenvalue of the coherency matrix over its trace. The file
/// holds 12 digits.
inline constexpr double kMuellerTolerance = 1e-6;

const std::vector<core::CsvColumn>& mueller_columns();
/// `core::CsvNumbers::RowCheck`: the matrix must be physical.
std::optional<std::pair<std::size_t, std::string>> mueller_row_fault(std::span<const double> row);

}  // namespace evenglow::tracer

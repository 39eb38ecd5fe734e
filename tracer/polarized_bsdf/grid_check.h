#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace evenglow::core {
class CsvNumbers;
}  // namespace evenglow::core

namespace evenglow::tracer {

/// Everything that keeps the rows from being a full grid in order: repeated rows, missing nodes (each of up to ten,
/// then their number; a file that ends before its grid is full gets one line), rows out of order. In order are rows
/// sorted by their six node columns, whichever of them changes fastest.
std::vector<core::Fault> grid_faults(const core::CsvNumbers& rows);

}  // namespace evenglow::tracer

#pragma once

#include <string>
#include <vector>

#include "design/report/report.h"

namespace evenglow::design {

/// Where the light went: a flow diagram for each report and a table of percent with errors. What leaves by the top
/// first, then by size (the greatest of all reports); the last row is the sum.
std::string energy_section(const std::vector<const Report*>& reports);

}  // namespace evenglow::design

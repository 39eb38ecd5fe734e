#pragma once

#include <string>
#include <vector>

#include "design/report/report.h"

namespace evenglow::design {

/// The luminance of the 13 spots of the uniformity figures: position, value and its part of the greatest of the 13,
/// two columns for each report. Reports without a map are left out.
std::string spot_table(const std::vector<const Report*>& reports);

}  // namespace evenglow::design

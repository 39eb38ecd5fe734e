#pragma once

#include <nlohmann/json.hpp>

#include "design/report/report.h"

namespace evenglow::design {

/// The block `dots` of result.json: rounds, the chosen one, its judgment beside that of the density. `report.dots` is
/// given.
nlohmann::ordered_json dots_json(const Report& report);

}  // namespace evenglow::design

#pragma once

#include <nlohmann/json.hpp>

#include "design/report/report.h"

/// Final figures, color, viewing angles and hot spots as parts of result.json, compare.json and batch.json. What is not
/// known is null.
namespace evenglow::design {

/// The figures of a finished design, as `final` in result.json.
nlohmann::ordered_json final_json(const FinalJudgment& f);
nlohmann::ordered_json color_json(const ColorJudgment& color);
/// `half_maximum`: of the whole area, and of the spots if there are any.
nlohmann::ordered_json half_maximum_json(const AngularLuminance& angular, const std::vector<SpotLuminance>& spots);
nlohmann::ordered_json hot_spot_json(const std::vector<HotSpots>& rows);

/// Adds the keys `color`, `half_maximum` and `hot_spot` of what the report holds.
void add_metrology(const Report& report, nlohmann::ordered_json& object);

}  // namespace evenglow::design

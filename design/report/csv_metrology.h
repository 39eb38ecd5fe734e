#pragma once

#include <filesystem>
#include <string>

#include "design/report/report.h"

/// Tables of color, viewing angles and hot spots.
namespace evenglow::design {

/// A row for each line of cells along each row of LEDs.
std::string hot_spots_csv(const std::vector<HotSpots>& rows);
/// As angular.csv, with the number (from 1) and the place of the spot before each row.
std::string angular_spots_csv(const std::vector<SpotLuminance>& spots);

/// Writes what the report holds: color_u.csv, color_v.csv, delta_uv.csv, each with its `_se`; hot_spots.csv;
/// angular_spots.csv.
void write_metrology(const Report& report, const std::filesystem::path& directory);

}  // namespace evenglow::design

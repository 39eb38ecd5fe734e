#pragma once

#include <filesystem>
#include <vector>

#include "app/run_file.h"
#include "design/problem/front_point.h"
#include "design/report/study.h"

namespace evenglow::app {

/// The front of a backlight as a study: RMS against efficiency with error bars, both against the level.
design::Study front_study(const Run& run, const std::string& command, const std::vector<design::FrontPoint>& points);

/// pareto.csv, pareto.json, pareto.html, pareto.png; density_01.csv ... and luminance_01.csv ... of each point.
void write_front(const design::Study& study, const Run& run, const std::vector<design::FrontPoint>& points,
                 const std::filesystem::path& directory);

}  // namespace evenglow::app

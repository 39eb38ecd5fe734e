#pragma once

#include <filesystem>

#include "design/report/report.h"

namespace evenglow::app {

/// A short table of the result for stdout.
void print_result(const design::Report& report, const std::filesystem::path& directory);

}  // namespace evenglow::app

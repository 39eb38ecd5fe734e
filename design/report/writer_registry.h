#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "design/report/report.h"

namespace evenglow::design {

/// Names of the formats that a run file may ask for (key `output`), in the order in which they are written.
std::vector<std::string> output_formats();
/// Those that are written where a run file does not say.
std::vector<std::string> default_output_formats();

/// Writes the files of each named format into `directory`, which is made if it is not there. An unknown name is a
/// broken promise (the run file was checked before); core::Error that names the path if a file cannot be written.
void write_report(const Report& report, const std::vector<std::string>& formats,
                  const std::filesystem::path& directory);
void write_report(const Comparison& comparison, const std::vector<std::string>& formats,
                  const std::filesystem::path& directory);

}  // namespace evenglow::design

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace evenglow::tracer {

/// Does the header name the column m00 (the file that `mueller_text` writes)?
bool is_mueller_file(std::string_view text);

/// Faults of such a file: what `core::CsvNumbers` refuses, units, matrices whose coherency matrix has an eigenvalue
/// below -1e-6 of its trace.
std::vector<core::Fault> mueller_faults(std::string_view text, const std::string& name);

}  // namespace evenglow::tracer

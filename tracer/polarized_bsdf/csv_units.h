#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace evenglow::tracer {

/// The first line of a film table or of film readings is a comment that names its units: degrees, nm, 1/sr. The fault
/// of a comment that names others (radians, um, cd/m2 without 1/sr ...), with its line; with `required` also of a file
/// without such a comment.
std::optional<core::Fault> unit_fault(std::string_view text, const std::string& name, bool required);

}  // namespace evenglow::tracer

#pragma once

#include <string_view>

namespace evenglow::core {

/// The version of the program, as in the build (`0.1.0`).
std::string_view version();

}  // namespace evenglow::core

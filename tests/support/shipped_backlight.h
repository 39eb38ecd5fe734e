#pragma once

#include <string>

#include "tests/support/scenes.h"

namespace evenglow::tests {

/// The backlight of a run file of configs/; `variant` empty: as the file has it.
tracer::BacklightSpec shipped_backlight(const std::string& file, const std::string& variant);

}  // namespace evenglow::tests

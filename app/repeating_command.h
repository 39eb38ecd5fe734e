#pragma once

#include <string>

#include "app/options.h"

namespace evenglow::app {

/// The word as a POSIX shell must be given it: in single quotes where it needs them.
std::string quoted(const std::string& word);

/// The command line that repeats a result: the words that change its numbers, and none that do not (`--threads`, `-o`).
std::string repeating_command(const std::string& command, const Options& options);

}  // namespace evenglow::app

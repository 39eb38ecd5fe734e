#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "design/engine/design_loop.h"

namespace evenglow::design {

/// Writes the state of a design to `file`, whole or not at all (written beside it, flushed to the disk, renamed).
/// `identity` says of which run it is. Throws Error when the disk refuses.
void save_checkpoint(const std::filesystem::path& file, const std::string& identity, const DesignProgress& progress);

/// Reads it back, to the same bits; none if there is no such file. Throws Error if it is damaged, of another version,
/// or of another run.
std::optional<DesignProgress> load_checkpoint(const std::filesystem::path& file, const std::string& identity);

}  // namespace evenglow::design

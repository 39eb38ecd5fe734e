#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "design/engine/design_loop.h"

namespace evenglow::design {

/// Writes the state of a design to `file`, whole or not at all, with a checksum, and keeps the state before
/// (state_file.h). `identity` says of which run it is. Throws Error when the disk refuses.
void save_checkpoint(const std::filesystem::path& file, const std::string& identity, const DesignProgress& progress);

/// Reads it back, to the same bits; none if there is no such file. If the file is damaged, of another version or gone,
/// and the one of the step before is good, that one counts and `note` (may be null) says so in one line; else empty.
/// Throws Error if neither is good, or if the state is of another run.
std::optional<DesignProgress> load_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                              std::string* note = nullptr);

/// The state in the JSON object of an unsealed file, and of which run it is. Throws Error for any other text.
DesignProgress parse_checkpoint(const std::string& object, std::string& identity);

}  // namespace evenglow::design

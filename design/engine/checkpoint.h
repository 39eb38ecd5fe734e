#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/math/cell_field.h"
#include "design/engine/design_loop.h"

namespace evenglow::design {

/// What a state must fit to be gone on from.
struct StateBounds {
  core::CellGrid density;    ///< over the plate
  core::CellGrid luminance;  ///< over the display
  std::uint64_t largest_photons = 0;
};

/// Writes the state of a design to `file`, whole or not at all, with a checksum, and keeps the state before
/// (state_file.h). `identity` says of which run it is. Throws Error when the disk refuses.
void save_checkpoint(const std::filesystem::path& file, const std::string& identity, const DesignProgress& progress);

/// Reads it back, to the same bits; none if there is no such file. If the file is damaged, of another version or gone,
/// and the one of the step before is good, that one counts and `note` (may be null) says so in one line; else empty.
/// A state that breaks `bounds` (may be null) counts as damaged, though its checksum may be right: anyone can make one.
/// Throws Error if neither is good, or if the state is of another run.
std::optional<DesignProgress> load_checkpoint(const std::filesystem::path& file, const std::string& identity,
                                              std::string* note = nullptr, const StateBounds* bounds = nullptr);

/// The state in the JSON object of an unsealed file, and of which run it is. Throws Error for any other text, and for
/// densities beyond [0, 1], steps that do not count from 0 and the like.
DesignProgress parse_checkpoint(const std::string& object, std::string& identity);

}  // namespace evenglow::design

#pragma once

#include <filesystem>

#include "core/config/config_state.h"

namespace evenglow::core {

/// The key of a map that names a file whose map lies under it: the keys of that file count unless the map has them.
inline constexpr std::string_view kIncludeKey = "include";

/// Puts in the place of every `include: FILE` in `value` and below what the file holds; FILE is taken relative to the
/// folder of the file that names it, and so are the files that an included value names. Included files may include
/// others, at most 8 deep, at most 200 files and 16 MiB in all. Values keep their places, so that a fault names the
/// file that it stands in. Faults are noted; `path` is that of `value`.
void expand_includes(ConfigState& state, ConfigValue& value, const std::string& path,
                     const std::filesystem::path& folder);

}  // namespace evenglow::core

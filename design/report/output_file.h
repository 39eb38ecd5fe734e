#pragma once

#include <filesystem>
#include <string_view>

namespace evenglow::design {

/// Writes a whole file, replacing one that is there: first beside it, then moved into place, so that nobody ever reads
/// half a file. Throws core::Error that names the path if it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace evenglow::design

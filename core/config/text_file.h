#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

/// Reading of small text files that strangers may have written.
namespace evenglow::core {

/// Largest run file, in bytes; also the most text it may hold after its aliases are followed.
inline constexpr std::size_t kMaxRunFileBytes = std::size_t{8} << 20;

/// The bytes of a regular file of at most `max_bytes`. Never waits on a pipe or device. Throws `ConfigError` (one
/// fault, of the file as a whole) for anything else, before it reads what is too large.
std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes = kMaxRunFileBytes);

/// Throws `ConfigError`, with line and column, unless `text` is UTF-8 without control characters.
void require_text(std::string_view text, const std::string& file_name);

}  // namespace evenglow::core

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace evenglow::core {

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits. The one door to OpenSSL.
/// Throws `Error` if the library refuses.
std::string sha256_hex(std::string_view bytes);
/// The same of what can be read of a file, in little memory whatever its size.
std::string sha256_hex_of_file(const std::filesystem::path& file);

}  // namespace evenglow::core

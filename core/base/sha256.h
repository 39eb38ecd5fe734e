#pragma once

#include <string>
#include <string_view>

namespace evenglow::core {

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits. The one door to OpenSSL.
/// Throws `Error` if the library refuses.
std::string sha256_hex(std::string_view bytes);

}  // namespace evenglow::core

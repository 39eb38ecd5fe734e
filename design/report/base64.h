#pragma once

#include <string>
#include <string_view>

namespace evenglow::design {

/// Bytes in the alphabet of RFC 4648, padded: for pictures within a page.
std::string base64(std::string_view bytes);

}  // namespace evenglow::design

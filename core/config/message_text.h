#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Text that is safe to print in a message of one line.
namespace evenglow::core {

/// Line breaks and other control characters as escapes (`\n`, `\x1b`, `\u2028`); the rest unchanged.
std::string one_line(std::string_view text);

/// `one_line`, and cut with `...` when longer than `max_length` bytes (never within a character).
std::string shown(std::string_view text, std::size_t max_length = 60);

/// Position in bytes of the first byte that is no UTF-8 text: a control character other than tab, line feed and
/// carriage return, or a malformed sequence.
std::optional<std::size_t> first_non_text(std::string_view text);

}  // namespace evenglow::core

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// What the YAML parser does not tell, or does not see. Inner part of core/config.
namespace evenglow::core {

/// Whether the quoted text whose opening quote (" or ') stands at `position` (a byte) of `text` is never closed. The
/// parser takes such a text as closed by the end of the file if a line break stands before it.
bool is_open_quote(std::string_view text, std::size_t position);

/// Advice for an error in line `line` (from 0), to be set behind the parser's words; empty: none.
std::string indentation_hint(std::string_view text, int line);

}  // namespace evenglow::core

#include "core/config/message_text.h"

#include <fmt/format.h>

namespace evenglow::core {
namespace {

/// Code point and length of the UTF-8 sequence at the front; none if malformed (overlong, surrogate, too large).
struct CodePoint {
  char32_t value = 0;
  std::size_t length = 0;
};

std::optional<CodePoint> front_code_point(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return CodePoint{lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return std::nullopt;
  char32_t value = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return std::nullopt;
    value = (value << 6) | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && value < 0x800) || (length == 4 && value < 0x10000);
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (overlong || surrogate || value > 0x10FFFF) return std::nullopt;
  return CodePoint{value, length};
}

std::string escape(char32_t value) {
  switch (value) {
    case U'\n':
      return "\\n";
    case U'\r':
      return "\\r";
    case U'\t':
      return "\\t";
    default:
      return value < 0x100 ? fmt::format("\\x{:02x}", static_cast<unsigned>(value))
                           : fmt::format("\\u{:04x}", static_cast<unsigned>(value));
  }
}

/// Control characters and what else ends a line or turns the direction of text.
bool breaks_line(char32_t value) {
  return value < 0x20 || (value >= 0x7F && value < 0xA0) || (value >= 0x2028 && value <= 0x202E) ||
         (value >= 0x2066 && value <= 0x2069);
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto point = front_code_point(text);
    const std::size_t length = point ? point->length : 1;
    if (!point) {
      result += escape(static_cast<unsigned char>(text.front()));
    } else if (breaks_line(point->value)) {
      result += escape(point->value);
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return result;
}

std::string shown(std::string_view text, std::size_t max_length) {
  if (text.size() <= max_length) return one_line(text);
  std::size_t end = max_length;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return one_line(text.substr(0, end)) + "...";
}

std::optional<std::size_t> first_non_text(std::string_view text) {
  std::size_t position = 0;
  while (position < text.size()) {
    const auto point = front_code_point(text.substr(position));
    if (!point) return position;
    const char32_t value = point->value;
    const bool white = value == U'\t' || value == U'\n' || value == U'\r';
    if ((value < 0x20 && !white) || value == 0x7F) return position;
    position += point->length;
  }
  return std::nullopt;
}

}  // namespace evenglow::core

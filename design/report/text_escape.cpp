#include "design/report/text_escape.h"

#include <algorithm>
#include <cstddef>

namespace evenglow::design {
namespace {

bool is_continuation(unsigned char byte) {
  return (byte & 0xC0U) == 0x80U;
}

/// Length of the well-formed UTF-8 character at the front (Unicode 15, table 3-7), 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first <= 0xDFU) return is_continuation(static_cast<unsigned char>(byte(1))) ? 2 : 0;
  const unsigned second = byte(1);
  const bool tail3 = is_continuation(static_cast<unsigned char>(byte(2)));
  const bool tail4 = tail3 && is_continuation(static_cast<unsigned char>(byte(3)));
  if (!is_continuation(static_cast<unsigned char>(second))) return 0;
  if (first == 0xE0U) return second >= 0xA0U && tail3 ? 3 : 0;
  if (first == 0xEDU) return second <= 0x9FU && tail3 ? 3 : 0;
  if (first >= 0xE1U && first <= 0xEFU) return tail3 ? 3 : 0;
  if (first == 0xF0U) return second >= 0x90U && tail4 ? 4 : 0;
  if (first >= 0xF1U && first <= 0xF3U) return tail4 ? 4 : 0;
  if (first == 0xF4U) return second <= 0x8FU && tail4 ? 4 : 0;
  return 0;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20U && c != '\n' && c != '\t') || byte == 0x7FU;
}

template <typename Replace>
std::string replaced(std::string_view text, Replace&& replacement) {
  std::string result;
  result.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    const std::string_view instead = replacement(c);
    if (instead.empty()) {
      result += c;
    } else {
      result += instead;
    }
  }
  return result;
}

}  // namespace

std::string clean_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (text.substr(0, 2) == "\r\n") {
      text.remove_prefix(1);  // line ends of Windows become ours
    } else if (length == 0 || is_control(text[0])) {
      result += "\uFFFD";
      text.remove_prefix(1);
    } else {
      result += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return result;
}

std::string html_escape(std::string_view text) {
  return replaced(clean_utf8(text), [](char c) -> std::string_view {
    switch (c) {
      case '&':
        return "&amp;";
      case '<':
        return "&lt;";
      case '>':
        return "&gt;";
      case '"':
        return "&quot;";
      case '\'':
        return "&#39;";
      default:
        return {};
    }
  });
}

std::string script_safe(std::string_view json) {
  std::string result = replaced(json, [](char c) -> std::string_view { return c == '<' ? "\\u003c" : ""; });
  for (const auto& [separator, escape] : {std::pair{"\u2028", "\\u2028"}, std::pair{"\u2029", "\\u2029"}}) {
    for (std::size_t at = 0; (at = result.find(separator, at)) != std::string::npos;) result.replace(at, 3, escape);
  }
  return result;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  return '"' + replaced(text, [](char c) -> std::string_view { return c == '"' ? "\"\"" : ""; }) + '"';
}

std::string one_line(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return result;
}

}  // namespace evenglow::design

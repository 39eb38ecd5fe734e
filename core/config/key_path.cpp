#include "core/config/key_path.h"

#include <algorithm>
#include <charconv>

#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

/// Takes `[12]` off the front of `rest`.
std::optional<KeyStep> take_index(std::string_view& rest) {
  const std::size_t end = rest.find(']');
  if (end == std::string_view::npos || end < 2 || end > 7) return std::nullopt;
  KeyStep step;
  const auto [stopped, error] = std::from_chars(rest.data() + 1, rest.data() + end, step.index);
  if (error != std::errc{} || stopped != rest.data() + end) return std::nullopt;
  rest.remove_prefix(end + 1);
  return step;
}

/// Takes a key off the front of `rest`.
std::optional<KeyStep> take_key(std::string_view& rest) {
  const std::size_t end = std::min(rest.find_first_of(".[]"), rest.size());
  if (end == 0) return std::nullopt;
  KeyStep step{std::string(rest.substr(0, end)), 0};
  rest.remove_prefix(end);
  return step;
}

}  // namespace

std::optional<std::vector<KeyStep>> parse_key_path(std::string_view path) {
  std::vector<KeyStep> steps;
  bool key_next = true;
  while (key_next || !path.empty()) {
    const auto step = key_next ? take_key(path) : take_index(path);
    if (!step) return std::nullopt;
    steps.push_back(*step);
    key_next = path.starts_with('.');
    if (key_next) path.remove_prefix(1);
    if (!key_next && !path.empty() && !path.starts_with('[')) return std::nullopt;
  }
  return steps;
}

std::string key_path(const std::string& parent, std::string_view key) {
  return (parent.empty() ? "" : parent + '.') + shown(key);
}

std::string item_path(const std::string& parent, std::size_t index) {
  return parent + '[' + std::to_string(index) + ']';
}

}  // namespace evenglow::core

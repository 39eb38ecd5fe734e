#include "core/config/yaml_limits.h"

#include <algorithm>
#include <string_view>

namespace evenglow::core {

std::string trouble_for_parser(const std::string& text) {
  // Counted wherever they stand, in a comment too: a sane file comes nowhere near the limit.
  const auto is_counted = [](char c) { return std::string_view("\n,:[]{}&!*?\"'").find(c) != std::string_view::npos; };
  const auto count = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_counted));
  return count > kMaxPunctuation ? "must not hold more than 1000000 line breaks and punctuation marks" : "";
}

}  // namespace evenglow::core

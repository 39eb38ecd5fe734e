#include "core/config/yaml_hints.h"

namespace evenglow::core {

bool is_open_quote(std::string_view text, std::size_t position) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // the parser does not count it
  if (position >= text.size()) return false;
  const char quote = text[position];
  if (quote != '"' && quote != '\'') return false;
  for (std::size_t i = position + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 == text.size() || text[i + 1] != quote) return false;
      ++i;  // '' stands for one quote
    }
  }
  return true;
}

std::string indentation_hint(std::string_view text, int line) {
  for (; line > 0; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return "";
    text.remove_prefix(end + 1);
  }
  const std::size_t first = text.find_first_not_of(" \t");
  const bool tab = text.substr(0, first).find('\t') != std::string_view::npos;
  return tab ? " (lines must be indented with spaces, not tabs)" : "";
}

}  // namespace evenglow::core

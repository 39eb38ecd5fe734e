#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/key_schema.h"

namespace evenglow::app {
namespace {

using core::DeclaredKey;

/// Text of one cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.replace(at, 1, "\\|");
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string words(const std::vector<std::string>& options) {
  std::string text;
  for (const std::string& option : options) text += (text.empty() ? "`" : ", `") + option + "`";
  return text;
}

std::string number_type(const DeclaredKey& key) {
  std::string text = key.type == "integer" || key.type == "count" || key.whole ? "whole number" : "number";
  const bool bounded = key.range && (std::isfinite(key.range->min) || std::isfinite(key.range->max));
  if (bounded) text += " in " + key.range->to_string();
  return text;
}

std::string list_type(const DeclaredKey& key) {
  const std::string each = number_type(key);
  if (key.min_count == key.max_count) return fmt::format("{} numbers, each {}", key.min_count, each);
  return fmt::format("{} to {} numbers, each {}", key.min_count, key.max_count, each);
}

std::string type_of(const DeclaredKey& key) {
  if (key.type == "choice") return words(key.options);
  if (key.type == "choices") return "list of " + words(key.options);
  if (key.type == "numbers") return list_type(key);
  if (key.type == "number" || key.type == "integer" || key.type == "count") return number_type(key);
  if (key.type == "map") return "map";
  if (key.type == "maps") return "list of maps";
  if (key.type == "boolean") return "`true`, `false`";
  return key.type;
}

std::string row(const DeclaredKey& key) {
  const std::string fallback = key.required ? "required" : key.fallback.empty() ? "" : "`" + key.fallback + "`";
  return fmt::format("| `{}` | {} | {} | {} |\n", key.key, cell(type_of(key)), cell(fallback), cell(key.help));
}

std::string heading(const DeclaredKey& key) {
  std::string text = key.node.empty() ? "The top" : "`" + key.node + "`";
  if (!key.kind.empty()) text += ", kind `" + key.kind + "`";
  return "\n## " + text + "\n\n| key | value | default | what it is |\n| --- | --- | --- | --- |\n";
}

}  // namespace

std::string key_reference(const std::vector<DeclaredKey>& keys) {
  std::vector<const DeclaredKey*> sorted;
  sorted.reserve(keys.size());
  for (const DeclaredKey& key : keys) sorted.push_back(&key);
  std::stable_sort(sorted.begin(), sorted.end(), [](const DeclaredKey* a, const DeclaredKey* b) {
    return std::pair(a->node, a->kind) < std::pair(b->node, b->kind);
  });
  std::string text =
      "# Keys of the run file\n\nMade by `evenglow schema --reference` from the declarations that read the file. The "
      "unit of a number is the ending of its key. `[]` stands for each item of a list. Any map, the top too, may "
      "hold `include: FILE`, a file that holds more of its keys: then what is required may stand there. Prose with "
      "examples: [run_file.md](run_file.md).\n";
  const DeclaredKey* last = nullptr;
  for (const DeclaredKey* key : sorted) {
    if (last == nullptr || last->node != key->node || last->kind != key->kind) text += heading(*key);
    text += row(*key);
    last = key;
  }
  return text;
}

}  // namespace evenglow::app

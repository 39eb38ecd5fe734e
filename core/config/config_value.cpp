#include "core/config/config_value.h"

#include <algorithm>

#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

/// Plain YAML words that need no quotes in flow text.
bool is_plain_word(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           c == '+' || c == '/' || c == '-';
  };
  return !text.empty() && text.front() != '-' && std::all_of(text.begin(), text.end(), plain);
}

/// In double quotes; the escapes of `one_line` are those of YAML.
std::string quoted_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return '"' + one_line(escaped) + '"';
}

/// A plain scalar may not gain quotes: `-5` is a number, `"-5"` is not.
std::string scalar_text(const ConfigValue& value) {
  const bool plain_number = !value.quoted && value.text.starts_with('-') && is_plain_word(value.text.substr(1));
  const bool plain = !value.quoted && is_plain_word(value.text);
  return plain || plain_number ? value.text : quoted_text(value.text);
}

}  // namespace

ConfigChild* ConfigValue::find(std::string_view key) {
  for (ConfigChild& child : children) {
    if (kind == Kind::kMap && child.key == key) return &child;
  }
  return nullptr;
}

const ConfigChild* ConfigValue::find(std::string_view key) const {
  return const_cast<ConfigValue*>(this)->find(key);
}

ConfigExtent extent_of(const ConfigValue& value) {
  ConfigExtent extent{1, value.text.size(), 0};
  int inner = -1;
  for (const ConfigChild& child : value.children) {
    const ConfigExtent part = extent_of(*child.value);
    extent.values += part.values;
    extent.bytes += part.bytes + child.key.size();
    inner = std::max(inner, part.depth);
  }
  if (value.is_map() || value.is_list()) extent.depth = std::max(inner, 0) + 1;
  return extent;
}

std::unique_ptr<ConfigValue> copy_of(const ConfigValue& value) {
  auto copy = std::make_unique<ConfigValue>();
  copy->kind = value.kind;
  copy->quoted = value.quoted;
  copy->text = value.text;
  copy->place = value.place;
  copy->children.reserve(value.children.size());
  for (const ConfigChild& child : value.children) {
    copy->children.push_back({child.key, child.place, copy_of(*child.value)});
  }
  return copy;
}

std::string flow_text(const ConfigValue& value) {
  if (value.kind == ConfigValue::Kind::kNull) return "null";
  if (value.is_scalar()) return scalar_text(value);
  std::string text;
  for (const ConfigChild& child : value.children) {
    if (!text.empty()) text += ", ";
    if (value.is_map()) text += flow_text(child.key) + ": ";
    text += flow_text(*child.value);
  }
  return value.is_map() ? '{' + text + '}' : '[' + text + ']';
}

std::string flow_text(const std::string& word) {
  return is_plain_word(word) ? word : quoted_text(word);
}

std::string described(const ConfigValue& value) {
  switch (value.kind) {
    case ConfigValue::Kind::kNull:
      return "nothing";
    case ConfigValue::Kind::kMap:
      return "a map";
    case ConfigValue::Kind::kList:
      return "a list";
    case ConfigValue::Kind::kScalar:
      break;
  }
  return value.quoted ? '"' + shown(value.text) + '"' : shown(value.text);
}

}  // namespace evenglow::core

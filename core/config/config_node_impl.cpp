#include "core/config/config_node_impl.h"

#include <algorithm>
#include <utility>

#include "core/config/key_path.h"
#include "core/config/number_text.h"
#include "core/config/suggestion.h"

namespace evenglow::core {

bool ConfigNode::Impl::is_muted() const {
  for (const Impl* node = this; node != nullptr; node = node->parent.get()) {
    if (node->muted) return true;
    if (node->value == nullptr) continue;
    const auto found = state->reads.find(node->value);
    if (found != state->reads.end() && found->second.closed) return true;
  }
  return false;
}

void ConfigNode::Impl::mute() const {
  if (value != nullptr) state->reads[value].closed = true;
}

const ConfigValue* ConfigNode::Impl::take(DeclaredKey declaration) const {
  const std::string key = declaration.key;
  declaration.node = pattern;
  declaration.unit = unit_of(key);
  const auto kind = state->kinds.find(path);
  if (kind != state->kinds.end() && key != "kind") declaration.kind = kind->second;
  state->declare(std::move(declaration));
  if (value == nullptr) return nullptr;
  if (!value->is_map()) {
    refuse(*value, path, "must be a map, got " + described(*value));
    mute();
    return nullptr;
  }
  MapReads& reads = state->reads[value];
  if (std::find(reads.known.begin(), reads.known.end(), key) == reads.known.end()) reads.known.push_back(key);
  const ConfigChild* found = value->find(key);
  return found != nullptr ? found->value.get() : nullptr;
}

void ConfigNode::Impl::mention(std::string_view key) const {
  const auto kind = state->kinds.find(path);
  state->mention({pattern, kind != state->kinds.end() ? kind->second : "", std::string(key)});
}

void ConfigNode::Impl::miss(std::string_view key, std::string_view help) const {
  const std::string missing_path = key_path(path, key);
  if (is_muted() || !state->refused.insert(missing_path).second) return;
  const std::string about = help.empty() ? "" : " (" + std::string(help) + ")";
  state->note(place, missing_path, "must be given" + about, true);
}

void ConfigNode::Impl::refuse(const ConfigValue& wrong, const std::string& at_path, std::string_view message) const {
  if (is_muted() || !state->refused.insert(at_path).second) return;
  state->note(wrong.place, at_path, message);
}

std::optional<double> ConfigNode::Impl::number_in(const ConfigValue& number, const std::string& at_path,
                                                  const Range& range) const {
  const Parsed<double> parsed = parse_number(number);
  if (parsed.value && range.contains(*parsed.value)) return parsed.value;
  refuse(number, at_path, parsed.value ? requirement(range) + ", got " + described(number) : parsed.fault);
  return std::nullopt;
}

long long ConfigNode::Impl::whole_number(const IntegerKey& declaration, const ConfigValue* found, bool exponent) const {
  const long long substitute = declaration.fallback.value_or(std::clamp(1LL, declaration.min, declaration.max));
  if (found == nullptr) {
    if (!declaration.fallback) miss(declaration.key, declaration.help);
    return substitute;
  }
  const Parsed<long long> parsed = parse_integer(*found, exponent);
  const bool inside = parsed.value && *parsed.value >= declaration.min && *parsed.value <= declaration.max;
  if (inside) return *parsed.value;
  const std::string outside = requirement(declaration.min, declaration.max) + ", got " + described(*found);
  refuse(*found, key_path(path, declaration.key), parsed.value ? outside : parsed.fault);
  return substitute;
}

std::optional<std::string> ConfigNode::Impl::word(const ChoiceKey& declaration) const {
  DeclaredKey remembered{"", "", std::string(declaration.key), "choice", std::string(declaration.help)};
  remembered.required = !declaration.fallback;
  remembered.fallback = declaration.fallback.value_or("");
  remembered.options = declaration.options;
  const ConfigValue* found = take(std::move(remembered));
  std::optional<std::string> result = declaration.fallback;
  if (found != nullptr) {
    result = option_in(*found, key_path(path, declaration.key), declaration.options);
  } else if (!result) {
    std::string about(declaration.help);
    for (const std::string& option : declaration.options) {
      about += (&option == &declaration.options.front() ? "; one of " : ", ") + option;
    }
    miss(declaration.key, about);
  }
  if (result && declaration.key == "kind") state->kinds[path] = *result;
  return result;
}

std::optional<std::string> ConfigNode::Impl::option_in(const ConfigValue& option, const std::string& at_path,
                                                       const std::vector<std::string>& options) const {
  const bool known = std::find(options.begin(), options.end(), option.text) != options.end();
  if (option.is_scalar() && known) return option.text;
  std::string message = "must be one of";
  for (const std::string& allowed : options) message += (&allowed == &options.front() ? " " : ", ") + allowed;
  message += "; got " + described(option);
  const auto meant = option.is_scalar() ? nearest(option.text, options) : std::nullopt;
  if (meant) message += ", did you mean `" + *meant + "`?";
  refuse(option, at_path, message);
  return std::nullopt;
}

std::shared_ptr<ConfigNode::Impl> ConfigNode::Impl::child(const std::shared_ptr<const Impl>& self, std::string_view key,
                                                          const ConfigValue* child_value) const {
  auto result = std::make_shared<Impl>();
  result->state = state;
  result->value = child_value;
  result->path = key_path(path, key);
  result->pattern = key_path(pattern, key);
  result->place = child_value != nullptr ? child_value->place : place;
  result->parent = self;
  return result;
}

}  // namespace evenglow::core

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/config/config_node.h"
#include "core/config/config_state.h"
#include "core/config/includes.h"
#include "core/config/key_path.h"
#include "core/config/located_override.h"
#include "core/config/message_text.h"
#include "core/config/yaml_limits.h"
#include "core/config/yaml_reader.h"

namespace evenglow::core {
namespace {

constexpr std::string_view kVariants = "variants";
constexpr std::string_view kSweep = "sweep";

bool is_variant_name(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' && std::all_of(name.begin(), name.end(), allowed);
}

/// Takes one step down from `value`, making the entry or next item if it is not there; null after a fault.
ConfigChild* step_into(ConfigValue& value, const KeyStep& step, const ConfigPlace& place, std::string& fault) {
  if (!step.is_index()) {
    if (!value.is_map()) fault = "must be a map to hold the key `" + shown(step.key) + "`, got " + described(value);
    if (!value.is_map()) return nullptr;
    if (ConfigChild* found = value.find(step.key)) return found;
  } else {
    const std::size_t size = value.children.size();
    if (!value.is_list()) fault = "must be a list to hold an index, got " + described(value);
    if (value.is_list() && step.index > size) {
      fault = fmt::format("holds {} items, the index must lie in [0, {}], got {}", size, size, step.index);
    }
    if (!fault.empty()) return nullptr;
    if (step.index < size) return &value.children[step.index];
  }
  value.children.push_back({step.key, place, nullptr});
  return &value.children.back();
}

std::unique_ptr<ConfigValue> empty_container(const KeyStep& content, const ConfigPlace& place) {
  auto value = std::make_unique<ConfigValue>();
  value->kind = content.is_index() ? ConfigValue::Kind::kList : ConfigValue::Kind::kMap;
  value->place = place;
  return value;
}

/// Lays `value` at the end of the steps; notes a fault if they lead nowhere.
void lay(ConfigState& state, const std::vector<KeyStep>& steps, std::unique_ptr<ConfigValue> value,
         const ConfigPlace& place) {
  ConfigValue* at = state.root.get();
  std::string path;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::string fault;
    ConfigChild* child = step_into(*at, steps[i], place, fault);
    if (child == nullptr) return state.note(place, path, fault);
    path = steps[i].is_index() ? item_path(path, steps[i].index) : key_path(path, steps[i].key);
    if (i + 1 == steps.size()) {
      if (child->value) state.replaced.push_back(std::move(child->value));
      child->value = std::move(value);
      child->place = place;
      return;
    }
    if (!child->value) child->value = empty_container(steps[i + 1], place);
    at = child->value.get();
  }
}

}  // namespace

ConfigDocument::Override located_override(const std::string& path, const ConfigValue& value, const ConfigPlace& place) {
  const std::string origin =
      place.line > 0 ? fmt::format("{}:{}:{}", *place.file, place.line, place.column) : *place.file;
  auto copy = std::make_shared<ConfigChild>(ConfigChild{path, place, copy_of(value)});
  return {path, flow_text(value), origin, std::move(copy)};
}

void ConfigDocument::apply(const Override& change) {
  ConfigPlace place{std::make_shared<const std::string>(change.origin), 0, 0};
  if (change.located) place = change.located->place;
  const std::string shown_path = shown(change.path);
  const auto steps = parse_key_path(change.path);
  if (!steps) {
    return state_->note(place, shown_path, "must be a key path such as trace.photons or backlight.films[1].axis_deg");
  }
  for (const std::string_view runs : {kVariants, kSweep}) {
    if (steps->front().key == runs) return state_->note(place, shown_path, std::string(runs) + " cannot be overridden");
  }
  std::vector<Fault> faults;
  auto value = change.located ? copy_of(*change.located->value)
                              : read_yaml(change.yaml, {place.file, shown_path, false}, faults);
  state_->note(faults);
  if (!value) return;
  if (!change.located) expand_includes(*state_, *value, shown_path, state_->folder);
  if (static_cast<int>(steps->size()) + extent_of(*value).depth > kMaxConfigDepth) {
    return state_->note(place, shown_path, kTooDeep);
  }
  lay(*state_, *steps, std::move(value), place);
}

std::vector<ConfigDocument::Variant> ConfigDocument::variants() const {
  const ConfigNode all = root().map(kVariants, "runs that differ from this one in some keys: name, then key paths");
  std::vector<Variant> result;
  for (const auto& [name, node] : all.entries()) {
    if (!is_variant_name(name)) {
      node.fault(
          "a variant's name must be of letters, digits, _, - and ., not begin with . and have at most 100 of them");
    }
    node.mark_read();
    const ConfigValue& changes = *state_->root->find(kVariants)->value->find(name)->value;
    if (!changes.is_map()) {
      node.fault("must be a map of key paths ({} for no change), got " + described(changes));
      continue;
    }
    result.emplace_back(name, std::vector<Override>{});
    for (const ConfigChild& change : changes.children)
      result.back().second.push_back(located_override(change.key, *change.value, change.place));
  }
  return result;
}

}  // namespace evenglow::core

#include <algorithm>
#include <utility>

#include "core/config/config_node.h"
#include "core/config/config_node_impl.h"
#include "core/config/key_path.h"

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxForeignFaults = 20;

/// Lets the walk over unread keys pass a value and all below.
void close_all(ConfigState& state, const ConfigValue& value) {
  if (value.is_map()) state.reads[&value].closed = true;
  for (const ConfigChild& child : value.children) close_all(state, *child.value);
}

}  // namespace

bool ConfigNode::present() const {
  return impl_->value != nullptr;
}

bool ConfigNode::is_map() const {
  return present() && impl_->value->is_map();
}

bool ConfigNode::is_list() const {
  return present() && impl_->value->is_list();
}

bool ConfigNode::has(std::string_view key) const {
  impl_->mention(key);
  return present() && impl_->value->find(key) != nullptr;
}

bool ConfigNode::has_map(std::string_view key) const {
  impl_->mention(key);
  const ConfigChild* child = present() ? impl_->value->find(key) : nullptr;
  return child != nullptr && child->value->is_map();
}

const std::string& ConfigNode::path() const {
  return impl_->path;
}

ConfigNode ConfigNode::map(std::string_view key, std::string_view help, bool required) const {
  DeclaredKey remembered{"", "", std::string(key), "map", std::string(help)};
  remembered.required = required;
  const ConfigValue* found = impl_->take(std::move(remembered));
  const bool wrong = found != nullptr && !found->is_map();
  if (wrong) impl_->refuse(*found, key_path(impl_->path, key), "must be a map, got " + described(*found));
  if (found == nullptr && required) impl_->miss(key, help);
  auto node = impl_->child(impl_, key, wrong ? nullptr : found);
  node->muted = wrong || (found == nullptr && required);
  return ConfigNode(std::move(node));
}

std::vector<std::pair<std::string, ConfigNode>> ConfigNode::entries() const {
  std::vector<std::pair<std::string, ConfigNode>> result;
  if (!is_map()) return result;
  impl_->state->reads[impl_->value].all_keys = true;
  for (const ConfigChild& child : impl_->value->children) {
    result.emplace_back(child.key, ConfigNode(impl_->child(impl_, child.key, child.value.get())));
  }
  return result;
}

std::string ConfigNode::yaml() const {
  return present() ? flow_text(*impl_->value) : "";
}

void ConfigNode::fault(std::string_view message) const {
  if (impl_->is_muted() || impl_->state->refused.contains(impl_->path)) return;
  impl_->state->note(impl_->place, impl_->path, message);
}

void ConfigNode::fault_at(std::string_view key, std::string_view message) const {
  const std::string path = key_path(impl_->path, key);
  if (impl_->is_muted() || impl_->state->refused.contains(path)) return;
  const ConfigChild* child = present() ? impl_->value->find(key) : nullptr;
  impl_->state->note(child != nullptr ? child->value->place : impl_->place, path, message);
}

void ConfigNode::fault_at(std::string_view key, const std::vector<Fault>& faults) const {
  const std::size_t told = std::min(faults.size(), kMaxForeignFaults);
  for (std::size_t i = 0; i < told; ++i) fault_at(key, faults[i].to_string());
  if (faults.size() > told) fault_at(key, "and " + std::to_string(faults.size() - told) + " more faults");
}

void ConfigNode::mark_read() const {
  if (present()) close_all(*impl_->state, *impl_->value);
}

}  // namespace evenglow::core

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/config/config_node.h"
#include "core/config/config_node_impl.h"
#include "core/config/key_path.h"
#include "core/config/number_text.h"

namespace evenglow::core {
namespace {

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_text(number);
  return '[' + text + ']';
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

DeclaredKey declared(const NumbersKey& key) {
  DeclaredKey result{"", "", std::string(key.key), "numbers", std::string(key.help)};
  result.required = !key.fallback;
  if (key.fallback) result.fallback = joined(*key.fallback);
  result.range = key.range;
  result.min_count = key.min_count;
  result.max_count = key.max_count;
  result.whole = key.whole;
  return result;
}

std::string count_fault(const NumbersKey& key, std::size_t count) {
  if (key.min_count == key.max_count) return fmt::format("must hold {} numbers, got {}", key.min_count, count);
  if (count < key.min_count) return fmt::format("must hold at least {} numbers, got {}", key.min_count, count);
  return fmt::format("must hold at most {} numbers, got {}", key.max_count, count);
}

/// One item of a list of numbers, in the unit of the file.
std::optional<double> number_item(const ConfigNode::Impl& node, const ConfigValue& item, const std::string& path,
                                  const NumbersKey& key) {
  const auto number = node.number_in(item, path, key.range);
  if (!number || !key.whole || std::trunc(*number) == *number) return number;
  node.refuse(item, path, "must be a whole number, got " + described(item));
  return std::nullopt;
}

/// The list in the unit of the file; none after a fault.
std::optional<std::vector<double>> number_list(const ConfigNode::Impl& node, const ConfigValue& list,
                                               const NumbersKey& key) {
  const std::string path = key_path(node.path, key.key);
  if (!list.is_list()) {
    node.refuse(list, path, "must be a list of numbers, got " + described(list));
    return std::nullopt;
  }
  if (list.children.size() < key.min_count || list.children.size() > key.max_count) {
    node.refuse(list, path, count_fault(key, list.children.size()));
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < list.children.size(); ++i) {
    const auto number = number_item(node, *list.children[i].value, item_path(path, i), key);
    if (number) numbers.push_back(*number);
  }
  if (numbers.size() == list.children.size()) return numbers;
  node.state->refused.insert(path);
  return std::nullopt;
}

}  // namespace

std::vector<double> ConfigNode::numbers(const NumbersKey& declaration) const {
  const ConfigValue* found = impl_->take(declared(declaration));
  std::optional<std::vector<double>> result;
  if (found != nullptr) result = number_list(*impl_, *found, declaration);
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  if (!result) result = declaration.fallback;
  if (!result) result.emplace(declaration.min_count, some_number(declaration.range));
  for (double& number : *result) number = to_internal(declaration.key, number);
  return *result;
}

std::vector<std::string> ConfigNode::choices(const ChoiceKey& declaration) const {
  DeclaredKey remembered{"", "", std::string(declaration.key), "choices", std::string(declaration.help)};
  remembered.required = !declaration.fallback;
  if (declaration.fallback) remembered.fallback = '[' + *declaration.fallback + ']';
  remembered.options = declaration.options;
  remembered.max_count = declaration.options.size();
  const ConfigValue* found = impl_->take(std::move(remembered));
  auto fallback = split_at_commas(declaration.fallback.value_or(""));
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  if (found == nullptr) return fallback;
  const std::string path = key_path(impl_->path, declaration.key);
  if (!found->is_list()) {
    impl_->refuse(*found, path, "must be a list of words, got " + described(*found));
    return fallback;
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < found->children.size(); ++i) {
    const ConfigValue& item = *found->children[i].value;
    const auto word = impl_->option_in(item, item_path(path, i), declaration.options);
    if (!word) continue;
    const bool twice = std::find(words.begin(), words.end(), *word) != words.end();
    if (twice) impl_->refuse(item, item_path(path, i), "must not be given twice, got " + described(item));
    if (!twice) words.push_back(*word);
  }
  return words;
}

std::vector<ConfigNode> ConfigNode::maps(std::string_view key, std::string_view help, std::size_t max_count) const {
  DeclaredKey remembered{"", "", std::string(key), "maps", std::string(help)};
  remembered.max_count = max_count;
  const ConfigValue* found = impl_->take(std::move(remembered));
  if (found == nullptr) return {};
  const std::string path = key_path(impl_->path, key);
  if (!found->is_list()) {
    impl_->refuse(*found, path, "must be a list of maps, got " + described(*found));
    return {};
  }
  if (found->children.size() > max_count) {
    impl_->refuse(*found, path, fmt::format("must hold at most {} maps, got {}", max_count, found->children.size()));
    return {};
  }
  std::vector<ConfigNode> nodes = ConfigNode(impl_->child(impl_, key, found)).items();
  for (ConfigNode& node : nodes) {
    const ConfigValue& item = *node.impl_->value;
    if (item.is_map()) continue;
    impl_->refuse(item, node.path(), "must be a map, got " + described(item));
    auto absent = std::make_shared<Impl>(*node.impl_);
    absent->value = nullptr;
    absent->muted = true;
    node.impl_ = std::move(absent);
  }
  return nodes;
}

std::vector<ConfigNode> ConfigNode::items() const {
  std::vector<ConfigNode> nodes;
  if (!is_list()) return nodes;
  for (std::size_t i = 0; i < impl_->value->children.size(); ++i) {
    auto item = std::make_shared<Impl>(*impl_);
    item->value = impl_->value->children[i].value.get();
    item->path = item_path(impl_->path, i);
    item->pattern += "[]";
    item->place = item->value->place;
    item->parent = impl_;
    nodes.push_back(ConfigNode(std::move(item)));
  }
  return nodes;
}

}  // namespace evenglow::core

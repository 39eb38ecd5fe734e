#include "core/config/config_node.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/config/config_node_impl.h"
#include "core/config/key_path.h"
#include "core/config/message_text.h"
#include "core/config/number_text.h"
#include "core/config/path_tree.h"

namespace evenglow::core {
namespace {

DeclaredKey declared(const NumberKey& key) {
  DeclaredKey result{"", "", std::string(key.key), "number", std::string(key.help)};
  result.required = !key.fallback;
  if (key.fallback) result.fallback = number_text(*key.fallback);
  result.range = key.range;
  return result;
}

DeclaredKey declared(const IntegerKey& key, const char* type) {
  DeclaredKey result{"", "", std::string(key.key), type, std::string(key.help)};
  result.required = !key.fallback;
  if (key.fallback) result.fallback = std::to_string(*key.fallback);
  result.range = Range::closed(static_cast<double>(key.min), static_cast<double>(key.max));
  return result;
}

DeclaredKey declared(const TextKey& key, const char* type) {
  DeclaredKey result{"", "", std::string(key.key), type, std::string(key.help)};
  result.required = !key.fallback;
  if (key.fallback) result.fallback = flow_text(*key.fallback);
  result.range = Range::closed(0, static_cast<double>(key.max_length));
  return result;
}

/// The text of a scalar of at most `max_length` bytes, or a fault.
std::optional<std::string> text_of(const ConfigNode::Impl& node, const ConfigValue& value, const TextKey& declaration) {
  const std::string path = key_path(node.path, declaration.key);
  if (!value.is_scalar()) {
    node.refuse(value, path, "must be text, got " + described(value));
    return std::nullopt;
  }
  if (value.text.size() > declaration.max_length) {
    node.refuse(value, path,
                fmt::format("must not be longer than {} bytes, got {}", declaration.max_length, value.text.size()));
    return std::nullopt;
  }
  return value.text;
}

/// What hinders the use of a file; empty: nothing.
std::string file_trouble(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const std::string shown_path = shown(file.string(), 200);
  if (status.type() == std::filesystem::file_type::not_found)
    return "must be an existing file, found none at " + shown_path;
  if (status.type() == std::filesystem::file_type::directory) return "must be a file, got the directory " + shown_path;
  if (status.type() == std::filesystem::file_type::regular) return "";
  return error ? "must be an existing file, cannot reach " + shown_path + ": " + error.message()
               : "must be a regular file, got a pipe, socket or device at " + shown_path;
}

}  // namespace

double ConfigNode::number(const NumberKey& declaration) const {
  const auto found = impl_->take(declared(declaration));
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  std::optional<double> value = declaration.fallback;
  if (found != nullptr) {
    const auto read = impl_->number_in(*found, key_path(impl_->path, declaration.key), declaration.range);
    if (read) value = read;
  }
  return to_internal(declaration.key, value.value_or(some_number(declaration.range)));
}

std::optional<double> ConfigNode::optional_number(const NumberKey& declaration) const {
  DeclaredKey remembered = declared(declaration);
  remembered.required = false;
  const auto found = impl_->take(std::move(remembered));
  if (found == nullptr) return std::nullopt;
  const auto read = impl_->number_in(*found, key_path(impl_->path, declaration.key), declaration.range);
  return to_internal(declaration.key, read.value_or(some_number(declaration.range)));
}

long long ConfigNode::integer(const IntegerKey& declaration) const {
  return impl_->whole_number(declaration, impl_->take(declared(declaration, "integer")), false);
}

long long ConfigNode::count(const IntegerKey& declaration) const {
  return impl_->whole_number(declaration, impl_->take(declared(declaration, "count")), true);
}

std::string ConfigNode::text(const TextKey& declaration) const {
  const auto found = impl_->take(declared(declaration, "text"));
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  std::optional<std::string> value;
  if (found != nullptr) value = text_of(*impl_, *found, declaration);
  return value ? *value : declaration.fallback.value_or("");
}

bool ConfigNode::boolean(const BoolKey& declaration) const {
  DeclaredKey remembered{"", "", std::string(declaration.key), "boolean", std::string(declaration.help)};
  remembered.required = !declaration.fallback;
  if (declaration.fallback) remembered.fallback = *declaration.fallback ? "true" : "false";
  const auto found = impl_->take(std::move(remembered));
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  if (found == nullptr) return declaration.fallback.value_or(false);
  const Parsed<bool> parsed = parse_boolean(*found);
  if (!parsed.value) impl_->refuse(*found, key_path(impl_->path, declaration.key), parsed.fault);
  return parsed.value.value_or(declaration.fallback.value_or(false));
}

std::string ConfigNode::choice(const ChoiceKey& declaration) const {
  const auto word = impl_->word(declaration);
  if (word) return *word;
  if (declaration.key == "kind") impl_->mute();
  if (declaration.fallback) return *declaration.fallback;
  return declaration.options.empty() ? "" : declaration.options.front();
}

std::optional<std::string> ConfigNode::kind(const ChoiceKey& declaration) const {
  auto word = impl_->word(declaration);
  if (!word) impl_->mute();
  if (impl_->is_muted()) return std::nullopt;
  return word;
}

std::filesystem::path ConfigNode::file(const TextKey& declaration) const {
  return file_in(declaration, "");
}

std::filesystem::path ConfigNode::file_in(const TextKey& declaration, std::string_view in_directory) const {
  const auto found = impl_->take(declared(declaration, "file"));
  if (found == nullptr && !declaration.fallback) impl_->miss(declaration.key, declaration.help);
  std::optional<std::string> name = declaration.fallback;
  if (found != nullptr) name = text_of(*impl_, *found, declaration);
  if (!name || (found == nullptr && name->empty())) return {};
  const std::string path = key_path(impl_->path, declaration.key);
  const auto& folders = impl_->state->folders;
  const auto own = found != nullptr ? folders.find(*found->place.file) : folders.end();
  std::filesystem::path file = (own != folders.end() ? own->second : impl_->state->folder) / *name;
  if (!in_directory.empty()) file /= in_directory;
  const bool nameless = name->empty() || name->find('\0') != std::string::npos;
  const auto tree = own != folders.end() ? impl_->state->trees.at(own->first) : tree_of(impl_->state->folder);
  std::string trouble = nameless ? "must be the name of a file, got " + described(*found) : "";
  if (trouble.empty() && found != nullptr) trouble = tree_trouble(tree, *name, file);
  if (trouble.empty()) trouble = file_trouble(file);
  if (trouble.empty()) {
    impl_->state->files.push_back(file);
    return file;
  }
  if (found != nullptr) impl_->refuse(*found, path, trouble);
  if (found == nullptr) fault_at(declaration.key, trouble);
  return {};
}

}  // namespace evenglow::core

#include "core/config/includes.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/config/key_path.h"
#include "core/config/message_text.h"
#include "core/config/path_tree.h"
#include "core/config/text_file.h"
#include "core/config/yaml_limits.h"
#include "core/config/yaml_reader.h"

namespace evenglow::core {
namespace {

constexpr int kMaxNesting = 8;
constexpr std::size_t kMaxFiles = 200;
constexpr std::size_t kMaxIncludedBytes = 2 * kMaxRunFileBytes;  // comments count: reading them takes time as well

/// Of the file that names others.
struct Home {
  std::filesystem::path folder;
  std::filesystem::path tree;
};

class Includes {
 public:
  explicit Includes(ConfigState& state) : state_(state) {}

  void expand(ConfigValue& value, const std::string& path, const Home& home, int nesting) {
    if (value.is_map()) expand_map(value, path, home, nesting);
    for (std::size_t i = 0; i < value.children.size(); ++i) {
      ConfigChild& child = value.children[i];
      if (!child.value || own_folder(child)) continue;
      expand(*child.value, value.is_list() ? item_path(path, i) : key_path(path, child.key), home, nesting);
    }
  }

 private:
  /// Came from an included file, and has been expanded with its folder.
  bool own_folder(const ConfigChild& child) const {
    return std::find(done_.begin(), done_.end(), child.value.get()) != done_.end();
  }

  void expand_map(ConfigValue& map, const std::string& path, const Home& home, int nesting) {
    ConfigChild* const found = map.find(kIncludeKey);
    if (found == nullptr) return;
    const ConfigChild include{found->key, found->place, std::move(found->value)};
    map.children.erase(map.children.begin() + (found - map.children.data()));
    const std::string include_path = key_path(path, kIncludeKey);
    if (!include.value->is_scalar() || include.value->text.empty()) {
      return state_.note(include.value->place, include_path,
                         "must be the name of a file that holds a map, got " + described(*include.value));
    }
    if (nesting >= kMaxNesting) {
      return state_.note(include.place, include_path,
                         fmt::format("must not nest deeper than {}: does a file include itself?", kMaxNesting));
    }
    if (++files_ > kMaxFiles) {
      if (files_ == kMaxFiles + 1) {
        state_.note(include.place, include_path, fmt::format("must not come more than {} times", kMaxFiles));
      }
      return;
    }
    const std::filesystem::path name = include.value->text;
    const std::filesystem::path file = home.folder / name;
    const std::string trouble = tree_trouble(home.tree, name, file);
    if (!trouble.empty()) return state_.note(include.value->place, include_path, trouble);
    const Home own{file.parent_path(), name.is_absolute() ? tree_of(file.parent_path()) : home.tree};
    std::unique_ptr<ConfigValue> part = read(file, own, include, include_path);
    if (!part) return;
    expand(*part, path, own, nesting + 1);
    for (ConfigChild& child : part->children) {
      if (map.find(child.key) != nullptr) continue;
      done_.push_back(child.value.get());
      map.children.push_back(std::move(child));
    }
    check_size(include, include_path);
  }

  /// The map of the file; null after a fault.
  std::unique_ptr<ConfigValue> read(const std::filesystem::path& file, const Home& own, const ConfigChild& include,
                                    const std::string& path) {
    try {
      const std::string text = read_text_file(file, kMaxRunFileBytes);
      text_ += text.size();
      if (text_ > kMaxIncludedBytes) {
        if (files_ <= kMaxFiles) state_.note(include.place, path, "must not lead to more than 16 MiB of files in all");
        files_ = kMaxFiles + 1;  // no more
        return nullptr;
      }
      require_text(text, file.string());
      const auto name = std::make_shared<const std::string>(file.string());
      std::vector<Fault> faults;
      auto value = read_yaml(text, {name, "", true}, faults);
      state_.note(faults);
      if (!value) return nullptr;
      if (!value->is_map()) {
        state_.note(include.value->place, path, "must name a file that holds a map of keys, got " + described(*value));
        return nullptr;
      }
      state_.folders[*name] = own.folder;
      state_.trees[*name] = own.tree;
      state_.files.push_back(file);
      const ConfigExtent extent = extent_of(*value);
      values_ += extent.values;
      bytes_ += extent.bytes;
      return value;
    } catch (const ConfigError& error) {
      for (const Fault& fault : error.faults()) state_.note(include.value->place, path, fault.to_string());
      return nullptr;
    }
  }

  void check_size(const ConfigChild& include, const std::string& path) {
    if (values_ <= kMaxConfigValues && bytes_ <= kMaxRunFileBytes) return;
    files_ = kMaxFiles + 1;  // no more
    state_.note(include.place, path, values_ > kMaxConfigValues ? kTooManyValues : kTooMuchText);
  }

  ConfigState& state_;
  std::vector<const ConfigValue*> done_;
  std::size_t files_ = 0, values_ = 0, bytes_ = 0, text_ = 0;
};

}  // namespace

void expand_includes(ConfigState& state, ConfigValue& value, const std::string& path,
                     const std::filesystem::path& folder) {
  Includes(state).expand(value, path, {folder, tree_of(folder)}, 0);
}

}  // namespace evenglow::core

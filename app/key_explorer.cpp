#include "app/key_explorer.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "app/run_file.h"
#include "core/config/config_node.h"

namespace evenglow::app {
namespace {

using core::ConfigDocument;
using core::DeclaredKey;

using Changes = std::vector<std::pair<std::string, std::string>>;  ///< key path and YAML

/// The first item of each list stands for all.
std::string concrete(std::string pattern) {
  for (std::size_t at = pattern.find("[]"); at != std::string::npos; at = pattern.find("[]", at + 3))
    pattern.replace(at, 2, "[0]");
  return pattern;
}

std::string path_of(const std::string& node, const std::string& key) {
  return node.empty() ? key : concrete(node) + "." + key;
}

/// Values that may bring other keys to light: what a number or a text is decides nothing (that it is there at all is
/// tried where a reader asks for it).
std::vector<std::string> samples(const DeclaredKey& key) {
  if (key.type == "choice") return key.options;
  if (key.type == "map") return {"{}"};
  if (key.type == "maps") return {"[{}]"};
  if (key.type == "boolean") return {"true", "false"};
  if (key.type == "file") return {"x"};
  return {};
}

class Explorer {
 public:
  std::vector<DeclaredKey> run() {
    // Some parts are read only where there is a plate, some only where there is none.
    try_changes({{"backlight", "{light_guide_plate: {}}"}});
    try_changes({{"backlight", "{}"}});
    while (!waiting_.empty()) {
      const Changes changes = std::move(waiting_.front());
      waiting_.pop_front();
      try_changes(changes);
    }
    for (DeclaredKey& key : found_)
      key.required = always_[{key.node, key.kind}].contains(key.key) || is_told_in_words(key);
    return std::move(found_);
  }

 private:
  void try_changes(const Changes& changes) {
    ConfigDocument document = ConfigDocument::parse("evenglow: 1\n", "run.yaml");
    for (const auto& [path, yaml] : changes) document.apply({path, yaml, "explorer"});
    try {
      read_keys(document);
    } catch (const core::Error&) {  // what was declared until then counts
    }
    const std::vector<DeclaredKey> declared = document.declared();
    note_required(declared, document.mentioned());
    for (const DeclaredKey& key : declared) note(key, changes);
    for (const core::MentionedKey& key : document.mentioned()) note(key, changes);
  }

  /// A key is required if every run that reads its map (of its kind) demands it: others may be demanded by the value of
  /// another key only, as the bound of a goal is.
  void note_required(const std::vector<DeclaredKey>& declared, const std::vector<core::MentionedKey>& mentioned) {
    std::map<MapOfKind, std::set<std::string>> demanded;
    for (const core::MentionedKey& key : mentioned) demanded[{key.node, key.kind}];
    for (const DeclaredKey& key : declared) {
      std::set<std::string>& keys = demanded[{key.node, key.kind}];
      if (key.required) keys.insert(key.key);
    }
    for (const auto& [map, keys] : demanded) {
      const auto [known, is_new] = always_.try_emplace(map, keys);
      if (!is_new) std::erase_if(known->second, [&kept = keys](const std::string& key) { return !kept.contains(key); });
    }
  }

  /// Its absence is told in words of its own, so that its declaration does not say that it is required.
  static bool is_told_in_words(const DeclaredKey& key) { return key.node.empty() && key.key == "backlight"; }

  /// A key of unknown type: one of these will be taken.
  void note(const core::MentionedKey& key, const Changes& changes) {
    if (!known_.insert(key.node + '\n' + key.kind + '\n' + key.key).second) return;
    for (const char* value : {"{}", "1", "x", "[1, 1]", "[{}]"}) enqueue(changes, path_of(key.node, key.key), value);
  }

  void note(const DeclaredKey& key, const Changes& changes) {
    if (!known_.insert(key.node + '\n' + key.kind + '\n' + key.key + '\n' + key.type).second) return;
    found_.push_back(key);
    // Another version is read, so that its fault is told in words, but not allowed.
    if (key.node.empty() && key.key == "evenglow") found_.back().range = core::Range::closed(1, 1);
    if (is_unjudged(key, changes)) return;
    for (const std::string& value : samples(key)) enqueue(changes, path_of(key.node, key.key), value);
  }

  /// Readers pass over a map whose kind is missing: what lies below it shows with the kind.
  bool is_unjudged(const DeclaredKey& key, const Changes& changes) const {
    if (key.key == "kind") return false;
    const bool has_kinds = std::any_of(found_.begin(), found_.end(), [&](const DeclaredKey& other) {
      return other.node == key.node && other.key == "kind" && other.required;
    });
    const std::string kind = path_of(key.node, "kind");
    return has_kinds && std::none_of(changes.begin(), changes.end(), [&](const auto& c) { return c.first == kind; });
  }

  void enqueue(const Changes& changes, const std::string& path, const std::string& value) {
    Changes more = changes;
    std::erase_if(more, [&](const auto& change) { return change.first == path; });
    more.emplace_back(path, value);
    waiting_.push_back(std::move(more));
  }

  using MapOfKind = std::pair<std::string, std::string>;  ///< node and kind

  std::set<std::string> known_;
  std::map<MapOfKind, std::set<std::string>> always_;  ///< required in every run so far
  std::vector<DeclaredKey> found_;
  std::deque<Changes> waiting_;
};

}  // namespace

std::vector<DeclaredKey> explore_keys() {
  return Explorer().run();
}

}  // namespace evenglow::app

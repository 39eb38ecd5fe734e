#include "core/config/config_state.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/config/key_path.h"
#include "core/config/message_text.h"
#include "core/config/suggestion.h"

namespace evenglow::core {
namespace {

/// Walks the tree for keys that no reader declared.
class UnreadKeys {
 public:
  explicit UnreadKeys(const ConfigState& state) : state_(state), clean_(state.faults.empty()) {}

  void visit(const ConfigValue& value, const std::string& path) {
    if (value.is_map()) visit_map(value, path);
    if (!value.is_list()) return;
    for (std::size_t i = 0; i < value.children.size(); ++i) {
      visit(*value.children[i].value, item_path(path, i));
    }
  }

  const std::vector<Fault>& faults() const { return faults_; }
  const std::set<std::string>& meant() const { return meant_; }  ///< paths that the unread keys probably meant

 private:
  void visit_map(const ConfigValue& map, const std::string& path) {
    const auto found = state_.reads.find(&map);
    const bool never_read = found == state_.reads.end();
    // A map that nobody read is left out once there is another fault, for that may be why nobody read it.
    if (never_read && !clean_) return;
    static const MapReads kNone;
    const MapReads& reads = never_read ? kNone : found->second;
    if (reads.closed) return;
    for (const ConfigChild& child : map.children) {
      const bool known = std::find(reads.known.begin(), reads.known.end(), child.key) != reads.known.end();
      if (known || reads.all_keys) {
        visit(*child.value, key_path(path, child.key));
      } else {
        add(child, path, reads.known);
      }
    }
  }

  void add(const ConfigChild& child, const std::string& path, const std::vector<std::string>& known) {
    const KeyAdvice advice = advise_on_key(child.key, known);
    if (advice.meant) meant_.insert(key_path(path, *advice.meant));
    faults_.push_back({one_line(*child.place.file), child.place.line, child.place.column, key_path(path, child.key),
                       one_line(advice.message)});
  }

  const ConfigState& state_;
  bool clean_;
  std::vector<Fault> faults_;
  std::set<std::string> meant_;
};

/// The run file first, then the other sources as they came; within a source by line and column.
void sort_by_place(std::vector<Fault>& faults, const std::string& main_file) {
  std::map<std::string, std::size_t> rank{{main_file, 0}};
  for (const Fault& fault : faults) rank.try_emplace(fault.file, rank.size());
  const auto place = [&](const Fault& fault) { return std::tuple(rank.at(fault.file), fault.line, fault.column); };
  std::stable_sort(faults.begin(), faults.end(), [&](const Fault& a, const Fault& b) { return place(a) < place(b); });
}

}  // namespace

void ConfigState::note(const ConfigPlace& at, const std::string& path, std::string_view message, bool missing) {
  faults.push_back({{one_line(*at.file), at.line, at.column, one_line(path), one_line(message)}, missing});
}

void ConfigState::note(const std::vector<Fault>& found) {
  for (const Fault& fault : found) faults.push_back({fault});
}

void ConfigState::declare(DeclaredKey declaration) {
  const std::string id = declaration.node + '\n' + declaration.kind + '\n' + declaration.key;
  if (declared_ids.insert(id).second) declared.push_back(std::move(declaration));
}

void ConfigState::mention(MentionedKey key) {
  if (std::find(mentioned.begin(), mentioned.end(), key) == mentioned.end()) mentioned.push_back(std::move(key));
}

std::vector<Fault> all_faults(const ConfigState& state) {
  UnreadKeys unread(state);
  unread.visit(*state.root, "");
  std::vector<Fault> faults;
  for (const NotedFault& noted : state.faults) {
    // One mistake, one line: a key that is spelled wrong is not also missing.
    if (!noted.missing || !unread.meant().contains(noted.fault.key)) faults.push_back(noted.fault);
  }
  faults.insert(faults.end(), unread.faults().begin(), unread.faults().end());
  sort_by_place(faults, one_line(*state.file));
  std::set<std::string> seen;
  std::erase_if(faults, [&](const Fault& fault) { return !seen.insert(fault.to_string()).second; });
  return faults;
}

}  // namespace evenglow::core

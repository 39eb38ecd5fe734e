#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/base/error.h"
#include "core/config/config_value.h"
#include "core/config/key_declarations.h"

/// What a document knows while it is read. Inner part of core/config: readers use `ConfigNode` and `ConfigDocument`.
namespace evenglow::core {

/// What the readers did with one map.
struct MapReads {
  std::vector<std::string> known;  ///< keys that a reader declared
  bool all_keys = false;           ///< its keys are free
  bool closed = false;             ///< not to be judged, nor what is below
};

struct NotedFault {
  Fault fault;
  bool missing = false;  ///< a required key is not there
};

struct ConfigState {
  std::shared_ptr<const std::string> file;  ///< name for messages
  std::string text;
  std::filesystem::path folder;
  std::unordered_map<std::string, std::filesystem::path> folders;  ///< of included files, by their name for messages
  std::unordered_map<std::string, std::filesystem::path> trees;    ///< as `folders`: what their relative paths keep to
  std::unique_ptr<ConfigValue> root;
  std::vector<std::unique_ptr<ConfigValue>> replaced;  ///< by overrides; nodes may still point there
  std::vector<NotedFault> faults;
  std::set<std::string> refused;  ///< paths of values that a typed read refused
  std::unordered_map<const ConfigValue*, MapReads> reads;
  std::vector<std::filesystem::path> files;  ///< that keys name, in the order of the reads
  std::vector<DeclaredKey> declared;
  std::unordered_set<std::string> declared_ids;
  std::vector<MentionedKey> mentioned;
  std::unordered_map<std::string, std::string> kinds;  ///< by path of the map

  void note(const ConfigPlace& at, const std::string& path, std::string_view message, bool missing = false);
  void note(const std::vector<Fault>& found);
  void declare(DeclaredKey declaration);
  void mention(MentionedKey key);
};

/// All faults of the document, those of unread keys included: ordered, each once.
std::vector<Fault> all_faults(const ConfigState& state);

}  // namespace evenglow::core

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// The tree of a run file, free of any YAML library. Inner part of core/config: readers use `ConfigNode`.
namespace evenglow::core {

/// Where a value was written. `line` and `column` count from 1 (columns in bytes); 0: not known.
struct ConfigPlace {
  std::shared_ptr<const std::string> file;  ///< name for messages, shared by all values of one source
  int line = 0;
  int column = 0;
};

struct ConfigChild;

struct ConfigValue {
  enum class Kind { kNull, kScalar, kMap, kList };

  Kind kind = Kind::kNull;
  bool quoted = false;  ///< of a scalar: written in quotes or as a block of text
  std::string text;     ///< of a scalar
  ConfigPlace place;
  std::vector<ConfigChild> children;  ///< of a map or list, in the order of the file

  bool is_map() const { return kind == Kind::kMap; }
  bool is_list() const { return kind == Kind::kList; }
  bool is_scalar() const { return kind == Kind::kScalar; }
  /// The child of a map by its key; null if there is none.
  ConfigChild* find(std::string_view key);
  const ConfigChild* find(std::string_view key) const;
};

/// An entry of a map, or an item of a list (then without a key). The value's address never changes.
struct ConfigChild {
  std::string key;
  ConfigPlace place;  ///< of the key; of the value in a list
  std::unique_ptr<ConfigValue> value;
};

/// How much a value holds, itself included.
struct ConfigExtent {
  std::size_t values = 0;
  std::size_t bytes = 0;  ///< of all texts and keys
  int depth = 0;          ///< 0 for a scalar, 1 for a flat map or list
};
ConfigExtent extent_of(const ConfigValue& value);

std::unique_ptr<ConfigValue> copy_of(const ConfigValue& value);

/// The value as one line of YAML (`{kind: lpp, axis_deg: 90}`) that reads back as the same value.
std::string flow_text(const ConfigValue& value);
std::string flow_text(const std::string& word);  ///< of a text, in quotes if it needs them

/// The value as the end of a message "..., got X": `270`, `"5"`, `a list`, `a map`, `nothing`.
std::string described(const ConfigValue& value);

}  // namespace evenglow::core

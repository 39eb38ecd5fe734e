#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/config/config_value.h"

/// From YAML text to the tree of values: the one place that knows yaml-cpp.
namespace evenglow::core {

/// Where the text comes from.
struct YamlSource {
  std::shared_ptr<const std::string> file;  ///< name for messages
  std::string path;                         ///< key path of the text's value, empty for a whole file
  bool located = true;                      ///< false: lines and columns mean nothing to the user
};

/// Reads one YAML document from UTF-8 text of at most `kMaxRunFileBytes`. Empty text is a null value. Faults that leave
/// the rest readable (a key twice, a tag, a merge key, a key that is no word) are added to `faults` and the reading
/// goes on; others (no YAML, two documents, too deep, too many values) are added and end it with null. Throws nothing.
std::unique_ptr<ConfigValue> read_yaml(const std::string& text, const YamlSource& source, std::vector<Fault>& faults);

}  // namespace evenglow::core

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>

#include "core/config/config_value.h"

/// What the reading of a YAML text holds of the maps and lists that are still open. Inner part of core/config.
namespace evenglow::core {

struct PendingKey {
  std::string text;
  ConfigPlace place;
  bool usable = true;
};

/// A map or list that is still open.
struct YamlFrame {
  std::unique_ptr<ConfigValue> value;
  std::size_t anchor = 0;  ///< number of its anchor, 0: none
  std::optional<PendingKey> key{};
  std::unordered_map<std::string, int> lines{};  ///< of the keys so far
};

}  // namespace evenglow::core

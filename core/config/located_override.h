#pragma once

#include <string>

#include "core/config/config_node.h"
#include "core/config/config_value.h"

/// Changes that stand in a file. Inner part of core/config.
namespace evenglow::core {

/// The change of the key at `path` to a value that was written at `place`; it keeps its place in messages.
ConfigDocument::Override located_override(const std::string& path, const ConfigValue& value, const ConfigPlace& place);

}  // namespace evenglow::core

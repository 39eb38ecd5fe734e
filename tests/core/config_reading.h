#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/config/config_node.h"

/// Helpers of the config tests: what a text, read by a reader, is faulted for.
namespace evenglow::core {

using Lines = std::vector<std::string>;
using Reader = std::function<void(const ConfigNode&)>;

inline Lines lines_of(const ConfigError& error) {
  Lines lines;
  for (const Fault& fault : error.faults()) lines.push_back(fault.to_string());
  return lines;
}

/// The fault lines of `finish()` or of the parsing itself; none if all is well.
inline Lines faults_of(const std::string& text, const Reader& read,
                       const std::vector<ConfigDocument::Override>& overrides = {}) {
  try {
    ConfigDocument document = ConfigDocument::parse(text, "run.yaml");
    for (const auto& change : overrides) document.apply(change);
    read(document.root());
    document.finish();
  } catch (const ConfigError& error) {
    return lines_of(error);
  }
  return {};
}

inline void read_all(const ConfigNode& node) {
  node.mark_read();
}

/// The faults of the text when every key is welcome.
inline Lines structure_faults(const std::string& text) {
  return faults_of(text, read_all);
}

}  // namespace evenglow::core

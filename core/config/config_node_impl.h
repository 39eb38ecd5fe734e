#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/config_node.h"
#include "core/config/config_state.h"

namespace evenglow::core {

/// What a node stands for. Inner part of core/config.
struct ConfigNode::Impl {
  ConfigState* state = nullptr;
  const ConfigValue* value = nullptr;  ///< null: absent
  std::string path{};
  std::string pattern{};  ///< the path with `[]` for indices
  ConfigPlace place{};    ///< of the value, or of the nearest map above that is present
  bool muted = false;     ///< an earlier fault explains what is wrong here
  std::shared_ptr<const Impl> parent{};

  /// No faults are noted here or below.
  bool is_muted() const;
  /// Ends the judging of this map, for an earlier fault explains what else is wrong here.
  void mute() const;
  /// Notes the declaration and gives the value of its key; null if it is absent. A node that is no map is a fault.
  const ConfigValue* take(DeclaredKey declaration) const;
  /// Remembers that a reader asked for the key.
  void mention(std::string_view key) const;
  /// Notes that a required key is not there.
  void miss(std::string_view key, std::string_view help) const;
  /// Notes that the value at `at_path` is wrong, once for each path.
  void refuse(const ConfigValue& wrong, const std::string& at_path, std::string_view message) const;

  /// A number of the range in the unit of the file; else a fault at `at_path`.
  std::optional<double> number_in(const ConfigValue& number, const std::string& at_path, const Range& range) const;
  /// The whole number at `found` (null: absent); after a fault the fallback or some number of the range.
  long long whole_number(const IntegerKey& declaration, const ConfigValue* found, bool exponent) const;
  /// The word of a choice, or its fallback; none after a fault.
  std::optional<std::string> word(const ChoiceKey& declaration) const;
  /// One of the options; else a fault at `at_path`.
  std::optional<std::string> option_in(const ConfigValue& option, const std::string& at_path,
                                       const std::vector<std::string>& options) const;

  std::shared_ptr<Impl> child(const std::shared_ptr<const Impl>& self, std::string_view key,
                              const ConfigValue* child_value) const;
};

}  // namespace evenglow::core

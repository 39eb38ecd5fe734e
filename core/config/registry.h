#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/config/config_node.h"

namespace evenglow::core {

/// From the name of a kind (`kind: dbef`) to the function that reads its keys and makes it. A plain table: the folder
/// that owns the kinds lists them in one place.
template <typename T>
class Registry {
 public:
  using Maker = std::function<T(const ConfigNode&)>;
  struct Entry {
    std::string name;
    std::string help;
    Maker make;
  };

  explicit Registry(std::vector<Entry> entries) : entries_(std::move(entries)) {}

  const std::vector<Entry>& entries() const { return entries_; }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    result.reserve(entries_.size());
    for (const Entry& entry : entries_) result.push_back(entry.name);
    return result;
  }

  /// Reads the key `kind` of the node and makes the thing. A missing or unknown kind is one fault of the node; then
  /// `std::nullopt`, and the node's other keys are not judged.
  std::optional<T> make(const ConfigNode& node, std::optional<std::string> fallback = {}) const {
    const auto kind = node.kind({"kind", "which kind of part this is", names(), std::move(fallback)});
    if (!kind) return std::nullopt;
    for (const Entry& entry : entries_) {
      if (entry.name == *kind) return entry.make(node);
    }
    return std::nullopt;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace evenglow::core

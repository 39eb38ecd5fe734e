#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Key paths: `backlight.films[1].axis_deg`.
namespace evenglow::core {

/// One step of a path: a key of a map, or an index of a list.
struct KeyStep {
  std::string key;  ///< empty for an index
  std::size_t index = 0;

  bool is_index() const { return key.empty(); }
};

/// The steps of a path; none if it is no path. It begins with a key; keys hold no `.`, `[` or `]`.
std::optional<std::vector<KeyStep>> parse_key_path(std::string_view path);

/// Path of a key of the map at `parent` (empty: the top). Keys of more than 60 bytes are cut.
std::string key_path(const std::string& parent, std::string_view key);

/// Path of an item of the list at `parent`.
std::string item_path(const std::string& parent, std::size_t index);

}  // namespace evenglow::core

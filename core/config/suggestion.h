#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the writer of a wrong word may have meant.
namespace evenglow::core {

/// Fewest insertions, deletions, replacements and swaps of neighbors that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of the options if it is near enough to be meant.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& options);

struct KeyAdvice {
  std::string message;                 ///< of the fault: "unknown key, did you mean `thickness_mm`?"
  std::optional<std::string> meant{};  ///< the known key that it names
};

/// About a key that no reader knows, given the keys that its reader knows.
KeyAdvice advise_on_key(std::string_view key, const std::vector<std::string>& known);

}  // namespace evenglow::core

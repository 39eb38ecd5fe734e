#pragma once

#include <string_view>

namespace evenglow::core {

/// Deepest nesting of the JSON files that are read: states, results, summaries.
inline constexpr int kMaxJsonDepth = 32;

/// Throws `Error` where brackets of a JSON text nest deeper than `kMaxJsonDepth`, before a parser keeps each of them.
/// Says nothing of what is no JSON for other reasons.
void require_shallow_json(std::string_view text);

}  // namespace evenglow::core

#include "core/config/json_depth.h"

#include <cstddef>
#include <string>

#include "core/base/error.h"

namespace evenglow::core {

void require_shallow_json(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxJsonDepth)
        throw Error("it nests deeper than " + std::to_string(kMaxJsonDepth) + " (byte " + std::to_string(i + 1) + ")");
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace evenglow::core

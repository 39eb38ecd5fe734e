#include "core/config/json_depth.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::core {
namespace {

std::string nested(int depth) {
  const auto n = static_cast<std::size_t>(depth);
  return std::string(n, '[') + std::string(n, ']');
}

TEST(JsonDepth, IsBounded) {
  EXPECT_NO_THROW(require_shallow_json(nested(kMaxJsonDepth)));
  EXPECT_THROW(require_shallow_json(nested(kMaxJsonDepth + 1)), Error);
  EXPECT_THROW(require_shallow_json(std::string(1000, '[')), Error);
  std::string objects;
  for (int i = 0; i <= kMaxJsonDepth; ++i) objects += "{\"a\":";
  EXPECT_THROW(require_shallow_json(objects), Error);
}

TEST(JsonDepth, BracketsInTextsAndThoseThatAreClosedDoNotCount) {
  EXPECT_NO_THROW(require_shallow_json("{\"a\\\"[\": \"" + std::string(1000, '[') + "\"}"));
  std::string wide = "[";
  for (int i = 0; i < 1000; ++i) wide += "[],";
  EXPECT_NO_THROW(require_shallow_json(wide + "0]"));
}

}  // namespace
}  // namespace evenglow::core

#include "core/config/key_path.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(KeyPath, StepsOfAPath) {
  const auto steps = parse_key_path("backlight.films[1].pair[20][0]");
  ASSERT_TRUE(steps);
  ASSERT_EQ(steps->size(), 6u);
  EXPECT_EQ((*steps)[0].key, "backlight");
  EXPECT_EQ((*steps)[1].key, "films");
  EXPECT_TRUE((*steps)[2].is_index());
  EXPECT_EQ((*steps)[2].index, 1u);
  EXPECT_EQ((*steps)[3].key, "pair");
  EXPECT_EQ((*steps)[4].index, 20u);
  EXPECT_EQ((*steps)[5].index, 0u);
}

TEST(KeyPath, WhatIsNoPath) {
  for (const char* text : {"", ".a", "a.", "a..b", "[0]", "a[", "a[]", "a[-1]", "a[1", "a[x]", "a]", "a[1]b", "a.[0]",
                           "a[1234567]", "a[ 1]"})
    EXPECT_FALSE(parse_key_path(text)) << text;
}

TEST(KeyPath, GrowsByKeysAndIndices) {
  EXPECT_EQ(key_path("", "films"), "films");
  EXPECT_EQ(item_path(key_path("backlight", "films"), 3), "backlight.films[3]");
  EXPECT_EQ(key_path("a", std::string(80, 'k')), "a." + std::string(60, 'k') + "...");
  EXPECT_EQ(key_path("a", "b\nc"), "a.b\\nc");
}

}  // namespace
}  // namespace evenglow::core

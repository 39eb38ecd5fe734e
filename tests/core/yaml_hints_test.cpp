#include "core/config/yaml_hints.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(OpenQuote, IsSeenToTheEndOfTheText) {
  EXPECT_TRUE(is_open_quote("a: \"never closed\nb: 1\n", 3));
  EXPECT_FALSE(is_open_quote("a: \"closed\"\n", 3));
  EXPECT_TRUE(is_open_quote("a: \"escaped \\\" only\n", 3));
  EXPECT_TRUE(is_open_quote("a: 'it''s\n", 3)) << "two quotes stand for one";
  EXPECT_FALSE(is_open_quote("a: 'it''s'\n", 3));
  EXPECT_FALSE(is_open_quote("a: word\n", 3)) << "no quote at all";
  EXPECT_FALSE(is_open_quote("a", 7)) << "beyond the text";
  EXPECT_TRUE(is_open_quote("\xEF\xBB\xBF'", 0)) << "a byte-order mark is not counted";
}

TEST(IndentationHint, TellsOfTabs) {
  const std::string text = "a:\n\tb: 1\n  c: 2\n";
  EXPECT_EQ(indentation_hint(text, 1), " (lines must be indented with spaces, not tabs)");
  EXPECT_EQ(indentation_hint(text, 0), "");
  EXPECT_EQ(indentation_hint(text, 2), "");
  EXPECT_EQ(indentation_hint(text, 9), "") << "no such line";
}

}  // namespace
}  // namespace evenglow::core

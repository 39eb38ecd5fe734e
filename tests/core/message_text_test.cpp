#include "core/config/message_text.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(OneLine, ControlCharactersAreEscaped) {
  EXPECT_EQ(one_line("plain \xC3\xA9 text"), "plain \xC3\xA9 text");
  EXPECT_EQ(one_line("a\nb\r\tc"), "a\\nb\\r\\tc");
  EXPECT_EQ(one_line(std::string("\0\x1b[31m", 6)), "\\x00\\x1b[31m");
  EXPECT_EQ(one_line("\xE2\x80\xA8"), "\\u2028") << "line separator";
  EXPECT_EQ(one_line("\xE2\x80\xAE"), "\\u202e") << "turns the direction of text";
  EXPECT_EQ(one_line("\xC2\x85"), "\\x85") << "next line";
}

TEST(OneLine, BytesThatAreNoTextAreEscaped) {
  EXPECT_EQ(one_line("\xFF"), "\\xff");
  EXPECT_EQ(one_line("\xC3"), "\\xc3") << "cut off";
  EXPECT_EQ(one_line("\xC0\x80"), "\\xc0\\x80") << "overlong";
  EXPECT_EQ(one_line("\xED\xA0\x80"), "\\xed\\xa0\\x80") << "surrogate";
  EXPECT_EQ(one_line("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond U+10FFFF";
}

TEST(Shown, IsCutBetweenCharacters) {
  EXPECT_EQ(shown("short", 5), "short");
  EXPECT_EQ(shown("longer", 5), "longe...");
  EXPECT_EQ(shown("abcd\xC3\xA9", 5), "abcd...");
}

TEST(FirstNonText, FindsTheByte) {
  EXPECT_FALSE(first_non_text("tab\tline\r\n\xE2\x82\xAC"));
  EXPECT_EQ(first_non_text(std::string_view("ab\0c", 4)), 2u);
  EXPECT_EQ(first_non_text("ab\x7F"), 2u);
  EXPECT_EQ(first_non_text("\xE2\x82"), 0u);
}

}  // namespace
}  // namespace evenglow::core

#include "design/report/text_escape.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

TEST(TextEscape, HtmlHasNoMarkupLeft) {
  EXPECT_EQ(html_escape("<a href='x' title=\"y\">&amp;"), "&lt;a href=&#39;x&#39; title=&quot;y&quot;&gt;&amp;amp;");
}

TEST(TextEscape, KeepsGoodUtf8AndReplacesTheRest) {
  EXPECT_EQ(clean_utf8("µ m² 😀\tx\r\ny"), "µ m² 😀\tx\ny");
  EXPECT_EQ(clean_utf8("a\xff"
                       "b"),
            "a\uFFFD"
            "b");
  EXPECT_EQ(clean_utf8("\xc0\xaf"), "\uFFFD\uFFFD");                // overlong
  EXPECT_EQ(clean_utf8("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");      // surrogate
  EXPECT_EQ(clean_utf8("\xe2\x82"), "\uFFFD\uFFFD");                // cut off
  EXPECT_EQ(clean_utf8(std::string("\0\x1b", 2)), "\uFFFD\uFFFD");  // control characters
}

TEST(TextEscape, ScriptCannotEndNorOpenAComment) {
  const std::string safe = script_safe(R"({"a":"</script><!--)"
                                       "\u2028"
                                       R"("})");
  EXPECT_EQ(safe, R"({"a":"\u003c/script>\u003c!--\u2028"})");
}

TEST(TextEscape, CsvFieldsAreQuotedWhenTheyMust) {
  EXPECT_EQ(csv_field("plain"), "plain");
  EXPECT_EQ(csv_field("a,\"b\""), "\"a,\"\"b\"\"\"");
}

}  // namespace
}  // namespace evenglow::design

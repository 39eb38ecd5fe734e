#include "tracer/sources/photometric_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using tracer::PhotometricText;

class PhotometricTextTest : public ::testing::Test {
 protected:
  PhotometricText text(const std::string& bytes) {
    write_text(folder_ / "t.ies", bytes);
    return PhotometricText(folder_ / "t.ies");
  }

  template <typename Read>
  std::string fault(const std::string& bytes, Read read) {
    try {
      PhotometricText t = text(bytes);
      read(t);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return {};
  }

  TempFolder folder_;
};

TEST_F(PhotometricTextTest, ReadsLinesThenNumbers) {
  PhotometricText t = text("caf\xe9 \r\n1, 2.5e1\r\n+3\n\x1a");
  EXPECT_EQ(t.next_line("name"), "caf\xe9");
  EXPECT_EQ(t.number("a", 0, 10), 1.0);
  EXPECT_EQ(t.number("b", 0, 100), 25.0);
  EXPECT_EQ(t.line(), 2);
  EXPECT_EQ(t.count("c", 0, 10), 3u);
  EXPECT_NO_THROW(t.expect_end("c"));
}

TEST_F(PhotometricTextTest, ADecimalCommaCountsInALine) {
  PhotometricText t = text(" 1,5 mm\n2\n");
  EXPECT_EQ(t.number_line("a", 0, 10), 1.5);
  EXPECT_EQ(t.count_line("b", 0, 10), 2u);
}

TEST_F(PhotometricTextTest, TellsThePlaceOfAFault) {
  EXPECT_THAT(fault("x\n 7 9\n", [](auto& t) { t.next_line("n"), t.number("a", 0, 8), t.number("b", 0, 8); }),
              HasSubstr("t.ies:2:4: b: must be a number in [0, 8], got \"9\""));
  EXPECT_THAT(fault("nan", [](auto& t) { t.number("a", 0, 8); }), HasSubstr(":1:1: a: must be a number"));
  EXPECT_THAT(fault("1.5", [](auto& t) { t.count("a", 0, 8); }), HasSubstr("a: must be a whole number, got 1.5"));
  EXPECT_THAT(fault("1\n", [](auto& t) { t.number("a", 0, 8), t.number("b", 0, 8); }),
              HasSubstr("must go on with the b, got the end of the file"));
  EXPECT_THAT(fault("", [](auto& t) { t.next_line("head"); }), HasSubstr("got the end of the file"));
  EXPECT_THAT(fault("1 x", [](auto& t) { t.number("a", 0, 8), t.expect_end("a"); }),
              HasSubstr("must end after a, got \"x\""));
  EXPECT_THAT(fault(std::string("a\nb\0c", 5), [](auto&) {}), HasSubstr("t.ies:2:1: must be text, got a zero byte"));
}

}  // namespace
}  // namespace evenglow::tests

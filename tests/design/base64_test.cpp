#include "design/report/base64.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

// The test vectors of RFC 4648, section 10.
TEST(Base64, TestVectorsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, BytesOfAllValues) {
  EXPECT_EQ(base64("\xff\xfe\x80"), "//6A");
  EXPECT_EQ(base64(std::string(3, '\0')), "AAAA");
}

}  // namespace
}  // namespace evenglow::design

#include "core/base/build_id.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(BuildId, IsTheChecksumThatTheLinkerLeft) {
  EXPECT_EQ(build_id().size(), 40u);
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(build_id(), build_id());
}

}  // namespace
}  // namespace evenglow::core

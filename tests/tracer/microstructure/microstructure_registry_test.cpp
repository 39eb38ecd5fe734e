#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bumps.h"
#include "tracer/microstructure/microstructure.h"

namespace evenglow::tests {
namespace {

TEST(MicrostructureRegistry, ShapesByName) {
  EXPECT_THAT(tracer::microstructure_registry().names(),
              testing::ElementsAre("printed_dot", "microlens", "cone", "pyramid", "v_groove"));
  for (const std::string& name : tracer::microstructure_registry().names()) {
    const tracer::Microstructure shape = shape_of("kind: " + name);
    EXPECT_EQ(shape.kind, name);
    ASSERT_TRUE(shape.optics(1.5));
  }
}

}  // namespace
}  // namespace evenglow::tests

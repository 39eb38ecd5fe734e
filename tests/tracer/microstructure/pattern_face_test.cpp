#include "tracer/microstructure/pattern_face.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tests {
namespace {

bool on_top(const std::string& keys) {
  const core::ConfigDocument document = core::ConfigDocument::parse("microstructure: {" + keys + "}\n", "run.yaml");
  const bool top = tracer::read_pattern_on_top(document.root().map("microstructure", "a pattern", true));
  document.finish();
  return top;
}

TEST(PatternFace, BottomUnlessTheTopIsAskedFor) {
  EXPECT_FALSE(on_top(""));
  EXPECT_FALSE(on_top("face: bottom"));
  EXPECT_TRUE(on_top("face: top"));
  EXPECT_THROW(on_top("face: left"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests

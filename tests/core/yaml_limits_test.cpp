#include "core/config/yaml_limits.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(YamlLimits, PunctuationIsCountedBeforeTheParserSeesIt) {
  EXPECT_EQ(trouble_for_parser("a: {b: [1, 2]}\n"), "");
  EXPECT_EQ(trouble_for_parser(std::string(kMaxPunctuation, '[')), "");
  EXPECT_EQ(trouble_for_parser(std::string(kMaxPunctuation + 1, '[')),
            "must not hold more than 1000000 line breaks and punctuation marks");
  EXPECT_EQ(trouble_for_parser(std::string(2 * kMaxPunctuation, 'x')), "");
}

}  // namespace
}  // namespace evenglow::core

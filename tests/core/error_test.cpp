#include "core/base/error.h"

#include <string>

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(Fault, OneLineWithWhatIsKnown) {
  EXPECT_EQ((Fault{"run.yaml", 3, 7, "backlight.films", "must be a list"}).to_string(),
            "run.yaml:3:7: backlight.films: must be a list");
  EXPECT_EQ((Fault{"run.yaml", 3, 0, "", "is odd"}).to_string(), "run.yaml:3: is odd");
  EXPECT_EQ((Fault{"run.yaml", 0, 7, "", "is odd"}).to_string(), "run.yaml: is odd");
  EXPECT_EQ((Fault{"--set", 0, 0, "", "must be key=value"}).to_string(), "--set: must be key=value");
  EXPECT_EQ((Fault{"", 0, 0, "", "alone"}).to_string(), "alone");
  EXPECT_EQ((Fault{"", 0, 0, "key", "alone"}).to_string(), "key: alone");
}

TEST(ConfigError, JoinsItsFaults) {
  const ConfigError error({Fault{"a", 1, 1, "k", "first"}, Fault{"a", 2, 1, "l", "second"}});
  EXPECT_STREQ(error.what(), "a:1:1: k: first\na:2:1: l: second");
  EXPECT_EQ(error.faults().size(), 2U);
  EXPECT_THROW(throw ConfigError(Fault{}), Error);
}

TEST(Expects, NamesThePromiseAndThePlace) {
  EXPECT_NO_THROW(expects(true, "nothing"));
  try {
    expects(false, "the moon is round");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("error_test.cpp:"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("the moon is round"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace evenglow::core

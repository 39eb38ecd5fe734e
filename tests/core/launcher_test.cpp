#include "core/parallel/launcher.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

class Launcher : public ::testing::Test {
 protected:
  Launcher() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMI_RANK", "PMIX_RANK"})
      ::unsetenv(name);
  }
  ~Launcher() override {
    ::unsetenv("OMPI_COMM_WORLD_SIZE");
    ::unsetenv("OMPI_COMM_WORLD_RANK");
  }
};

TEST_F(Launcher, AProcessStartedAloneIsOne) {
  EXPECT_FALSE(core::started_by_launcher());
  EXPECT_EQ(core::launched_ranks(), 1);
}

TEST_F(Launcher, TheVariablesOfMpirunAreRead) {
  ::setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  EXPECT_EQ(core::launched_ranks(), 1) << "without a rank it is left over from elsewhere";
  ::setenv("OMPI_COMM_WORLD_RANK", "3", 1);
  EXPECT_TRUE(core::started_by_launcher());
  EXPECT_EQ(core::launched_ranks(), 4);
}

}  // namespace
}  // namespace evenglow::tests

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/parallel/rank_link.h"

/// A program without MPI under a launcher: left out of a build with MPI (tests/CMakeLists.txt).
namespace evenglow::core {
namespace {

using testing::HasSubstr;

class NoMpiLink : public testing::Test {
 protected:
  NoMpiLink() { clear(); }
  ~NoMpiLink() override { clear(); }

  static void clear() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMI_RANK", "PMIX_RANK",
                             "SLURM_STEP_NUM_TASKS"}) {
      ::unsetenv(name);
    }
  }
  static void launched(const char* ranks) {
    ::setenv("OMPI_COMM_WORLD_SIZE", ranks, 1);
    ::setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  }
};

TEST_F(NoMpiLink, AProcessOfItsOwnHasNoLink) {
  EXPECT_EQ(world_link(), nullptr);
  launched("1");
  EXPECT_EQ(world_link(), nullptr) << "mpirun -n 1";
}

/// Else each of them would do the whole run, and write to one directory.
TEST_F(NoMpiLink, OneOfSeveralIsRefusedAndToldWhatToBuild) {
  launched("2");
  try {
    world_link();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("built without MPI (-DEVENGLOW_MPI=ON)"));
  }
}

}  // namespace
}  // namespace evenglow::core

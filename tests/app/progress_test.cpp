#include "app/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace evenglow::app {
namespace {

design::StepRecord some_step() {
  design::StepRecord record;
  record.step = 3;
  record.photons = 2'000'000;
  record.rms = 0.0523;
  record.rms_corrected = {0.0312, 0.0041};
  record.efficiency = {0.4567, 0.001};
  record.mean_density = 0.2345;
  record.wall_s = 1.25;
  return record;
}

TEST(Progress, AStepIsOneLineWithItsUnits) {
  EXPECT_EQ(describe(some_step()),
            "step 3: 2e+06 photons, RMS 5.23 % (corrected 3.12 +- 0.41 %), efficiency 45.67 %, density 0.2345, 1.2 s");
}

TEST(Progress, WithoutATerminalOnlyLinesAreWritten) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress(false);
    progress.begin("step 0");
    progress.photons(1, 2);
    progress.photons(2, 2);
    progress.line("done");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "done\n");
}

TEST(Progress, AFaultForProgramsIsAnObject) {
  ::testing::internal::CaptureStderr();
  tell("fault", "a \"b\"\xff", true);
  tell("fault", "plain", false);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "{\"event\":\"fault\",\"text\":\"a \\\"b\\\"\xEF\xBF\xBD\"}\nplain\n");
}

TEST(Progress, QuietWritesNothing) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress(true);
    progress.begin("step 0");
    progress.photons(2, 2);
    progress.line("done");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace evenglow::app

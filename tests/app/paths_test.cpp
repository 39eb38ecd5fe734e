#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow paths` and `evenglow trace`: single photons for the eye.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class SinglePhotons : public ::testing::Test {
 protected:
  SinglePhotons() { write_text(folder_ / "tiny.yaml", kTinyRun); }
  ProgramResult run(const std::vector<std::string>& words) const { return evenglow(words, folder_.path()); }

  TempFolder folder_;
};

TEST_F(SinglePhotons, PathsDrawsTheStackAndNeverOverAFile) {
  ASSERT_EQ(run({"paths", "tiny.yaml", "-o", "section.svg", "--count", "5"}).code, 0);
  const std::string svg = file_text(folder_ / "section.svg");
  EXPECT_THAT(svg, StartsWith("<svg xmlns="));
  for (const char* part : {"reflectors.bottom", "light_guide_plate", "films[0]:diffuser", "films[1]:dbef"})
    EXPECT_THAT(svg, HasSubstr(part));
  const ProgramResult again = run({"paths", "tiny.yaml", "-o", "section.svg"});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("must not be there yet"));
  EXPECT_EQ(file_text(folder_ / "section.svg"), svg);
  EXPECT_EQ(run({"paths", "tiny.yaml", "-o", "section.svg", "--overwrite", "--window", "1", "3"}).code, 0);
  EXPECT_THAT(file_text(folder_ / "section.svg"), HasSubstr("mm</text>"));
}

TEST_F(SinglePhotons, AFallingWindowIsRefused) {
  const ProgramResult result = run({"paths", "tiny.yaml", "-o", "section.svg", "--window", "3", "1"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--window: must be two rising positions"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "section.svg"));
}

TEST_F(SinglePhotons, TraceFollowsOnePhotonTheSameEachTime) {
  const ProgramResult first = run({"trace", "tiny.yaml", "--photon", "3"});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, StartsWith("photon 3 of step 0, stream 0, seed 7: "));
  EXPECT_THAT(first.out, HasSubstr("source"));
  EXPECT_EQ(run({"trace", "tiny.yaml", "--photon", "3"}).out, first.out);
  EXPECT_NE(run({"trace", "tiny.yaml", "--photon", "4"}).out, first.out);
}

}  // namespace
}  // namespace evenglow::tests

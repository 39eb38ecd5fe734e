#include "tracer/sources/intensity_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

class IntensityCsvTest : public ::testing::Test {
 protected:
  tracer::IntensityCsv read(const std::string& text) {
    write_text(folder_ / "led.csv", text);
    return tracer::read_intensity_csv(folder_ / "led.csv");
  }

  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "none";
  }

  TempFolder folder_;
};

TEST_F(IntensityCsvTest, RowsMayStandInAnyOrder) {
  const auto csv = read("# degrees, cd\ntheta_deg,phi_deg,intensity_cd\n90,0,1\n0,90,2\n0,0,2\n90,90,3\n");
  EXPECT_TRUE(csv.absolute);
  EXPECT_EQ(csv.table.phi.size(), 5u);  // a quadrant fills the circle
  EXPECT_NEAR(csv.table.intensity(0.5 * core::kPi, 1.5 * core::kPi), 3.0, 1e-12);
  EXPECT_NEAR(csv.table.intensity(0.5 * core::kPi, core::kPi), 1.0, 1e-12);
}

TEST_F(IntensityCsvTest, WithoutAzimuthsItIsRound) {
  const auto csv = read("theta_deg,intensity\n0,4\n90,0\n");
  EXPECT_FALSE(csv.absolute);
  EXPECT_NEAR(csv.table.intensity(0.25 * core::kPi, 3.0), 2.0, 1e-12);
}

TEST_F(IntensityCsvTest, Faults) {
  EXPECT_THAT(fault(""), HasSubstr("led.csv"));
  EXPECT_THAT(fault("theta_deg\n0\n90\n"), HasSubstr("either a column intensity or intensity_cd, got none"));
  EXPECT_THAT(fault("theta_deg,intensity,intensity_cd\n0,1,1\n"), HasSubstr("got both"));
  EXPECT_THAT(fault("theta_deg,intensity\n0,1\n"), HasSubstr("two values of theta_deg"));
  EXPECT_THAT(fault("theta_deg,intensity\n0,1\n190,1\n"), HasSubstr("led.csv:3:1: theta_deg"));
  EXPECT_THAT(fault("theta_deg,intensity\n0,1\n90,-1\n"), HasSubstr("led.csv:3:4: intensity"));
  EXPECT_THAT(fault("theta_deg,intensity\n0,1\n90,nan\n"), HasSubstr("intensity"));
  EXPECT_THAT(fault("theta_deg,intensity\n0,1\n90,1\n90,2\n"), HasSubstr("led.csv:4: must not give theta_deg 90"));
  EXPECT_THAT(fault("theta_deg,phi_deg,intensity\n0,0,1\n90,0,1\n0,90,1\n"),
              HasSubstr("every theta_deg (2) with every"));
  EXPECT_THAT(fault("theta_deg,phi_deg,intensity\n0,0,1\n90,0,1\n0,80,1\n90,80,1\n"), HasSubstr("phi_deg: must be 0"));
}

}  // namespace
}  // namespace evenglow::tests

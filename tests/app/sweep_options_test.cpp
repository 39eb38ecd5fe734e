#include "app/sweep_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::app {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr SweepRange kAngles{0, 90, true};

std::string fault_of(const std::string& text, const SweepRange& range = kAngles) {
  try {
    sweep_values("--sigma", text, range);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SweepOptions, RangesAndLists) {
  EXPECT_THAT(sweep_values("--sigma", "0:30:10", kAngles), ElementsAre(0, 10, 20, 30));
  EXPECT_THAT(sweep_values("--sigma", "0:25:10", kAngles), ElementsAre(0, 10, 20));
  EXPECT_THAT(sweep_values("--sigma", "0:0.3:0.1", kAngles),
              ElementsAre(0, DoubleNear(0.1, 1e-12), DoubleNear(0.2, 1e-12), 0.3));
  EXPECT_THAT(sweep_values("--sigma", "5:5:1", kAngles), ElementsAre(5));
  EXPECT_THAT(sweep_values("--sigma", "7", kAngles), ElementsAre(7));
  EXPECT_THAT(sweep_values("--sigma", "7,1.5e1,3", kAngles), ElementsAre(7, 15, 3));
}

TEST(SweepOptions, RefusesInOneLine) {
  for (const char* text : {"", "a", "1:2", "1:2:3:4", "1,,2", "nan", "inf", "0x10", "1 2", "1:2:"}) {
    EXPECT_THAT(fault_of(text), HasSubstr("--sigma: must be FROM:TO:STEP")) << text;
  }
  EXPECT_THAT(fault_of("0:90:10"), HasSubstr("must lie in [0, 90), got 90"));
  EXPECT_EQ(fault_of("0:90:10", {0, 90, false}), "accepted");
  EXPECT_THAT(fault_of("-1"), HasSubstr("got -1"));
  EXPECT_THAT(fault_of("0:80:0"), HasSubstr("STEP must be above 0"));
  EXPECT_THAT(fault_of("0:80:-1"), HasSubstr("STEP must be above 0"));
  EXPECT_THAT(fault_of("80:0:1"), HasSubstr("TO must be at least FROM"));
  EXPECT_THAT(fault_of("0:80:1e-300"), HasSubstr("at most 10000 values"));
}

TEST(SweepOptions, Lights) {
  using enum tracer::SweepLight;
  EXPECT_THAT(sweep_lights("pass,none,pass"), ElementsAre(pass, natural));
  EXPECT_THAT(sweep_lights("all"), ElementsAre(natural, pass, block, diagonal, right, left));
  EXPECT_STREQ(name_of(diagonal), "45");
  EXPECT_THROW(sweep_lights("circular"), core::ConfigError);
  EXPECT_THROW(sweep_lights(""), core::ConfigError);
}

TEST(SweepOptions, Photons) {
  EXPECT_EQ(sweep_photons("2e4"), 20000u);
  for (const char* text : {"0", "1.5", "-3", "1e12", "many", ""}) EXPECT_THROW(sweep_photons(text), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::app

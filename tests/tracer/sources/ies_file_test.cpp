#include "tracer/sources/ies_file.h"

#include <cmath>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/photometric_files.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using core::kPi;
using ::testing::HasSubstr;

double cosine(double theta_deg) {
  return std::max(0.0, std::cos(theta_deg * core::kRadPerDeg));
}

class IesFileTest : public ::testing::Test {
 protected:
  tracer::IntensityTable read(const std::string& text) {
    write_text(folder_ / "led.ies", text);
    return tracer::read_ies_file(folder_ / "led.ies");
  }
  tracer::IntensityTable read(const Ies& ies) { return read(ies.text()); }

  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const core::ConfigError& error) {
      EXPECT_EQ(error.faults().size(), 1u);
      return error.what();
    }
    return "none";
  }

  TempFolder folder_;
};

TEST_F(IesFileTest, FluxOfALambertianSource) {
  Ies ies;
  ies.intensity = [](double t, double) { return 2.5 * cosine(t); };
  EXPECT_NEAR(total_flux(read(ies)), 2.5 * kPi, 1e-3 * 2.5 * kPi);
  ies.vertical = steps(0, 180, 2.5);
  ies.horizontal = steps(0, 360, 45);
  EXPECT_NEAR(total_flux(read(ies)), 2.5 * kPi, 1e-3 * 2.5 * kPi);
}

TEST_F(IesFileTest, FactorsMultiply) {
  Ies ies;
  const double plain = total_flux(read(ies));
  ies.multiplier = 3;
  ies.factors = "0.5 0.25 1";
  EXPECT_NEAR(total_flux(read(ies)), 1.5 * plain, 1e-9);
  // Before 1995 the second number was the ballast-lamp photometric factor.
  for (const char* labels : {"IESNA91\n[TEST] x\n", "A label of 1986\n", ""}) {
    ies.labels = labels;
    EXPECT_NEAR(total_flux(read(ies)), 0.375 * plain, 1e-9) << labels;
  }
  ies.labels = "IESNA:LM-63-1995\n";
  EXPECT_NEAR(total_flux(read(ies)), 1.5 * plain, 1e-9);
  ies.tilt = "TILT=INCLUDE\n1\n3\n-90 0 90\n0.7 0.9 0.8\n";
  EXPECT_NEAR(total_flux(read(ies)), 1.35 * plain, 1e-9);
  ies.lamps = "2 800";  // the intensities are those of the source, not of 1000 lm
  EXPECT_NEAR(total_flux(read(ies)), 1.35 * plain, 1e-9);
}

TEST_F(IesFileTest, AllSymmetries) {
  // I = 2 + cos(2 phi) is symmetric to both planes, so every range must give the same.
  Ies ies;
  ies.intensity = [](double t, double p) { return cosine(t) * (2.0 + std::cos(2.0 * p * core::kRadPerDeg)); };
  for (const auto& [first, last] : {std::pair(0, 90), {0, 180}, {0, 360}, {90, 270}}) {
    ies.horizontal = steps(first, last, 5);
    const auto table = read(ies);
    EXPECT_EQ(table.phi.size(), 73u);
    EXPECT_NEAR(total_flux(table), 2.0 * kPi, 2e-3 * kPi);
    for (const double p : {20.0, 110.0, 200.0, 290.0}) {
      EXPECT_NEAR(table.intensity(0.5, p * core::kRadPerDeg), ies.intensity(0.5 / core::kRadPerDeg, p), 1e-3)
          << first << " " << last << " " << p;
    }
  }
  // One-sided: sin(phi) > 0 only above.
  ies.horizontal = steps(90, 270, 5);
  ies.intensity = [](double, double p) { return 1.0 + std::sin(p * core::kRadPerDeg); };
  EXPECT_NEAR(read(ies).intensity(0.5, 0.25 * kPi), 1.0 + std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(read(ies).intensity(0.5, 1.75 * kPi), 1.0 - std::sqrt(0.5), 1e-9);
}

TEST_F(IesFileTest, FaultsAreToldWithTheirPlace) {
  const std::string good = Ies().text();
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  EXPECT_EQ(fault(good), "none");
  EXPECT_THAT(fault(""), HasSubstr("led.ies:1:1: must go on with the line TILT="));
  EXPECT_THAT(fault("hello\nworld\n"), HasSubstr("line TILT= of an IES LM-63 file, got the end"));
  EXPECT_THAT(fault(changed("TILT=NONE", "TILT=other.tlt")), HasSubstr("led.ies:4:1: TILT: must be NONE or INCLUDE"));
  EXPECT_THAT(fault(good.substr(0, good.size() / 2)), HasSubstr("got the end of the file"));
  EXPECT_THAT(fault(changed("1 2 0.001", "2 2 0.001")), HasSubstr("photometric type: must be 1 (type C), got 2"));
  EXPECT_THAT(fault(changed("1 -1 1 91 1", "1 -1 1 91 1000000000")), HasSubstr("number of horizontal angles"));
  EXPECT_THAT(fault(changed("1 -1 1 91 1", "1 -1 1 90000 90000")), HasSubstr("must not hold more than 1000000"));
  EXPECT_THAT(fault(changed("1 -1 1 91 1", "1 -1 1 90 1")), HasSubstr("horizontal angles: must be 0 alone"));
  EXPECT_THAT(fault(changed("1 -1 1 91 1", "1 -1 -1 91 1")), HasSubstr("candela multiplier: must be a number in"));
  EXPECT_THAT(fault(changed("0 1 2 3 ", "0 2 1 3 ")), HasSubstr("vertical angles: must rise, got 1 after 2"));
  EXPECT_THAT(fault(changed("0 1 2 3 ", "0.5 1 2 3 ")), HasSubstr("vertical angles: must begin with 0 or 90"));
  EXPECT_THAT(fault(changed("\n1 1 1", "\n1 -1 1")), HasSubstr("intensity: must be a number in [0"));
  EXPECT_THAT(fault(changed("\n1 1 1", "\n1 nan 1")), HasSubstr("intensity: must be a number in [0"));
  EXPECT_THAT(fault(changed("\n1 1 1", "\n1 1e999 1")), HasSubstr("intensity: must be a number in [0"));
  EXPECT_THAT(fault(good + "1 1\n"), HasSubstr("must end after 1 x 91 intensities"));
  EXPECT_THAT(fault(changed("\n1 1 1", "\n1 1 x")), HasSubstr("got \"x\""));
}

/// configs/data/example_led.ies: 8 lm, half of the intensity at 57.5 degrees along the edge and at 60 across it.
TEST_F(IesFileTest, TheExample) {
  const auto led = tracer::read_ies_file(std::string(EVENGLOW_SOURCE_DIR) + "/configs/data/example_led.ies");
  EXPECT_NEAR(total_flux(led), 8.0, 8e-3);
  const double peak = led.intensity(0.0, 0.0);
  EXPECT_NEAR(led.intensity(57.5 * core::kRadPerDeg, 0.0) / peak, 0.5, 1e-3);
  EXPECT_NEAR(led.intensity(60.0 * core::kRadPerDeg, 0.5 * kPi) / peak, 0.5, 1e-3);
}

TEST_F(IesFileTest, AHugeFileIsRefusedUnread) {
  write_text(folder_ / "led.ies", "x");
  std::filesystem::resize_file(folder_ / "led.ies", 100u << 20);
  EXPECT_THROW(tracer::read_ies_file(folder_ / "led.ies"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests

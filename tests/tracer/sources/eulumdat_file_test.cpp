#include "tracer/sources/eulumdat_file.h"

#include <cmath>

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

double cosine(double gamma_deg) {
  return std::max(0.0, std::cos(gamma_deg * core::kRadPerDeg));
}

class EulumdatFileTest : public ::testing::Test {
 protected:
  tracer::IntensityTable read(const std::string& text) {
    write_text(folder_ / "led.ldt", text);
    return tracer::read_eulumdat_file(folder_ / "led.ldt");
  }
  tracer::IntensityTable read(const Eulumdat& file) { return read(file.text()); }

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

TEST_F(EulumdatFileTest, FluxOfALambertianSource) {
  Eulumdat file;
  file.intensity = [](double g, double) { return 1000.0 / kPi * cosine(g); };  // 1000 lm per 1000 lm
  EXPECT_NEAR(total_flux(read(file)), 1000.0, 1.0);
  file.lamps = "2\n1\nLED\n9,5\n\n\n0\n3\nother\n77\n\n\n0\n";  // the first of two sets counts; a decimal comma
  EXPECT_NEAR(total_flux(read(file)), 9.5, 0.0095);
  file.lamps = "1\n-1\nLED\n9.5\n\n\n0\n";  // absolute photometry
  file.factor = "2";
  EXPECT_NEAR(total_flux(read(file)), 19.0, 0.019);
}

TEST_F(EulumdatFileTest, AllSymmetries) {
  Eulumdat file;
  file.planes = steps(0, 345, 15);
  // Symmetric to both planes.
  const auto even = [](double g, double c) { return cosine(g) * (2.0 + std::cos(2.0 * c * core::kRadPerDeg)); };
  file.intensity = even;
  for (const int symmetry : {0, 2, 3, 4}) {
    file.symmetry = symmetry;
    const auto table = read(file);
    EXPECT_EQ(table.phi.size(), 25u) << symmetry;
    for (const double c : {15.0, 75.0, 120.0, 165.0, 240.0, 285.0, 345.0}) {
      EXPECT_NEAR(table.intensity(0.5, c * core::kRadPerDeg), even(0.5 / core::kRadPerDeg, c), 1e-3)
          << symmetry << " " << c;
    }
  }
  // Symmetric to one plane only: cos c to C0-C180, sin c to C90-C270.
  file.symmetry = 2;
  file.intensity = [](double, double c) { return 1.0 + std::cos(c * core::kRadPerDeg); };
  EXPECT_NEAR(read(file).intensity(0.5, 1.75 * kPi), 1.0 + std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(read(file).intensity(0.5, 1.25 * kPi), 1.0 - std::sqrt(0.5), 1e-9);
  file.symmetry = 3;
  file.intensity = [](double, double c) { return 1.0 + std::sin(c * core::kRadPerDeg); };
  EXPECT_NEAR(read(file).intensity(0.5, 0.75 * kPi), 1.0 + std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(read(file).intensity(0.5, 1.25 * kPi), 1.0 - std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(read(file).intensity(0.5, 1.75 * kPi), 1.0 - std::sqrt(0.5), 1e-9);
}

TEST_F(EulumdatFileTest, FaultsAreToldWithTheirPlace) {
  Eulumdat file;
  const std::string good = file.text();
  EXPECT_EQ(fault(good), "none");
  EXPECT_THAT(fault(""), HasSubstr("must go on with the company (line 1), got the end of the file"));
  EXPECT_THAT(fault(good.substr(0, 200)), HasSubstr("got the end of the file"));
  EXPECT_THAT(fault(good.substr(0, good.size() - 10)), HasSubstr("must go on with the intensity"));
  EXPECT_THAT(fault(good + "1\n"), HasSubstr("must end after 1 x 181 intensities"));
  const auto with = [](auto change) {
    Eulumdat changed;
    change(changed);
    return changed.text();
  };
  EXPECT_THAT(fault(with([](auto& f) { f.symmetry = 5; })), HasSubstr("led.ldt:3:1: symmetry indicator Isym (line 3)"));
  EXPECT_THAT(fault(with([](auto& f) { f.factor = "0"; })), HasSubstr("led.ldt:24:1: conversion factor"));
  EXPECT_THAT(fault(with([](auto& f) { f.lamps = "1\n1\nLED\n-1\n\n\n0\n"; })), HasSubstr("flux of the lamps"));
  EXPECT_THAT(fault(with([](auto& f) { f.lamps = "0\n"; })), HasSubstr("number of sets of lamps"));
  EXPECT_THAT(fault(with([](auto& f) { f.lamps = "999999999\n"; })), HasSubstr("number of sets of lamps"));
  EXPECT_THAT(fault(with([](auto& f) { f.intensity = [](double, double) { return -1.0; }; })), HasSubstr("intensity:"));
  EXPECT_THAT(fault(with([](auto& f) { f.intensity = [](double, double) { return std::nan(""); }; })),
              HasSubstr("intensity: must be a number"));
  EXPECT_THAT(fault(with([](auto& f) { f.gammas = {0, 20, 10}; })), HasSubstr("gamma angles: must rise"));
  EXPECT_THAT(fault(with([](auto& f) { f.gammas = {10, 20}; })), HasSubstr("gamma angles: must begin with 0"));
  EXPECT_THAT(fault(with([](auto& f) { f.symmetry = 4, f.planes = {0, 60, 120, 180, 240, 300}; })),
              HasSubstr("must be a multiple of 4 with Isym 4, got 6"));
  EXPECT_THAT(fault(with([](auto& f) {
                f.symmetry = 4, f.planes = {0, 80, 180, 270};
              })),
              HasSubstr("C angles: must run from 0 to 90 degrees with Isym 4, got 0 to 80"));
  std::string huge = good;
  huge.replace(huge.find("\r\n1\r\n0\r\n181"), 5, "\r\n99999\r\n");
  EXPECT_THAT(fault(huge), HasSubstr("must not hold more than 1000000 intensities"));
}

}  // namespace
}  // namespace evenglow::tests

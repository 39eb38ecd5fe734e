#include "tracer/polarized_bsdf/hemispherical_table.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/light/fresnel.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;
constexpr const char* kHeader = "sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block\n";

TEST(HemisphericalTable, DataFollowTheirFormula) {
  const auto table = HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv"));
  for (const double degrees : {0.0, 30.0, 45.0, 60.0, 80.0, 90.0}) {
    const double c = std::max(0.0, std::cos(degrees * kRad));
    const double share =
        (1.0 - core::slab_reflectance_natural(c, 1.58)) / (1.0 - core::slab_reflectance_natural(1.0, 1.58));
    const auto row = table.at(degrees * kRad);
    EXPECT_NEAR(row.transmittance_pass, 0.887 * share, 1e-6);
    EXPECT_NEAR(row.transmittance_block, 0.053 * share, 1e-6);
    EXPECT_NEAR(row.transmittance_pass + row.reflectance_pass, 0.985, 1e-9);
    EXPECT_NEAR(row.transmittance_block + row.reflectance_block, 0.985, 1e-9);
  }
}

TEST(HemisphericalTable, IsLinearBetweenAndHeldBeyond) {
  const auto table = HemisphericalTable::parse(std::string(kHeader) + "60,0.4,0.5,0,1\n0,0.8,0.1,0,1\n", "h.csv");
  EXPECT_NEAR(table.at(30 * kRad).transmittance_pass, 0.6, 1e-12);
  EXPECT_NEAR(table.at(80 * kRad).transmittance_pass, 0.4, 1e-12);
}

TEST(HemisphericalTable, WavelengthsAreLinearBetweenAndHeldBeyond) {
  std::string header = kHeader;
  header.insert(header.size() - 1, ",lambda_nm");
  const auto table = HemisphericalTable::parse(
      header + "0,0.8,0.1,0,1,450\n60,0.4,0.5,0,1,450\n0,0.4,0.1,0,1,650\n30,0.2,0.5,0,1,650\n", "h.csv");
  EXPECT_EQ(table.wavelengths_nm(), (std::vector<double>{450, 650}));
  EXPECT_NEAR(table.at_wavelength(300).at(30 * kRad).transmittance_pass, 0.6, 1e-12);
  EXPECT_NEAR(table.at_wavelength(650).at(15 * kRad).transmittance_pass, 0.3, 1e-12);
  EXPECT_NEAR(table.at_wavelength(900).at(15 * kRad).transmittance_pass, 0.3, 1e-12);
  // 500 nm: 3/4 of the first, 1/4 of the second, also where only one of them has a node.
  EXPECT_NEAR(table.at_wavelength(500).at(30 * kRad).transmittance_pass, 0.75 * 0.6 + 0.25 * 0.2, 1e-12);
  EXPECT_NEAR(table.at_wavelength(500).at(60 * kRad).transmittance_pass, 0.75 * 0.4 + 0.25 * 0.2, 1e-12);
  EXPECT_THROW(table.at(0.0), core::Error) << "of which wavelength?";
  EXPECT_TRUE(HemisphericalTable::read(tests::data_file("dbef_hemispherical.csv")).wavelengths_nm().empty());
  EXPECT_THROW(HemisphericalTable::parse(header + "0,0.8,0.1,0,1,450\n0,0.8,0.1,0,1,450\n", "h.csv"),
               core::ConfigError);
}

TEST(HemisphericalTable, RefusesGainAndRepeatedAngles) {
  const auto fault = [](const std::string& rows) -> std::string {
    try {
      HemisphericalTable::parse(kHeader + rows, "h.csv");
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(fault("0,0.8,0.3,0,1\n").find("h.csv:2:7: reflectance_pass: must be at most"), 0u);
  EXPECT_NE(fault("0,0.8,0.1,0,1\n0,0.8,0.1,0,1\n").find("h.csv:3:1: sigma_deg: must hold each angle once"),
            std::string::npos);
  EXPECT_NE(fault("91,0.8,0.1,0,1\n").find("[0, 90]"), std::string::npos);
}

}  // namespace
}  // namespace evenglow::tracer

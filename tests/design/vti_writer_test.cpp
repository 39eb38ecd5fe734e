#include "design/report/vti_writer.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::string decoded(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(alphabet.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
    }
  }
  return bytes;
}

/// The arrays of a file by name; each has its length before it.
std::map<std::string, std::vector<double>> arrays_of(const std::string& xml) {
  const std::regex array("<DataArray type=\"Float64\" Name=\"([^\"]*)\" format=\"binary\">([^<]*)</DataArray>");
  std::map<std::string, std::vector<double>> arrays;
  for (std::sregex_iterator it(xml.begin(), xml.end(), array), end; it != end; ++it) {
    const std::string bytes = decoded((*it)[2]);
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);  // little-endian machines alone
    EXPECT_EQ(length, bytes.size() - 8);
    std::vector<double> values(length / 8);
    std::memcpy(values.data(), bytes.data() + 8, length);
    arrays[(*it)[1]] = values;
  }
  return arrays;
}

TEST(VtiWriter, HoldsTheMapsAsTheyAre) {
  Report r = samples::report();
  r.luminance.values[3] = std::numeric_limits<double>::quiet_NaN();
  const std::string xml = vti_text(named_maps(r), r.luminance.grid);
  EXPECT_NE(xml.find("WholeExtent=\"0 6 0 4 0 0\" Origin=\"0 0 0\" Spacing=\"2 1.5 1\""), std::string::npos) << xml;
  const auto arrays = arrays_of(xml);
  ASSERT_EQ(arrays.size(), 4U);
  const auto& luminance = arrays.at("luminance (cd/m2)");
  ASSERT_EQ(luminance.size(), 24U);
  EXPECT_TRUE(std::isnan(luminance[3]));
  EXPECT_EQ(luminance[5], r.luminance.values[5]);
  EXPECT_EQ(arrays.at("luminance_se (cd/m2)"), r.luminance_se.values);
  EXPECT_EQ(arrays.at("density"), core::resample_nearest(r.density, r.luminance.grid).values);
}

TEST(VtiWriter, GivesADensityOnOtherCellsAFileOfItsOwn) {
  const samples::Folder folder("vti");
  const Report r = samples::report();
  VtiWriter().write(r, folder.path());
  const auto own = arrays_of(samples::content(folder.path() / "density.vti"));
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own.at("density"), r.density.values);
  const samples::Folder same("vti_same");
  Report equal = samples::report();
  equal.density = samples::ramp(6, 4, 0.1);
  VtiWriter().write(equal, same.path());
  EXPECT_TRUE(std::filesystem::exists(same.path() / "maps.vti"));
  EXPECT_FALSE(std::filesystem::exists(same.path() / "density.vti"));
}

TEST(VtiWriter, WritesNothingWithoutMaps) {
  const samples::Folder folder("vti_none");
  VtiWriter().write(Report{}, folder.path());
  VtiWriter().write(compare_reports("t", "c", {samples::report("a")}), folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace evenglow::design

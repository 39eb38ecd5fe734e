#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/ray_files.h"
#include "tests/support/temp_folder.h"
#include "tracer/sources/ray_file_layout.h"

namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

class Tm25HeadTest : public ::testing::Test {
 protected:
  tracer::RayFileLayout read(const std::string& bytes) {
    write_text(folder_ / "led.tm25ray", bytes);
    return tracer::read_tm25_head(folder_ / "led.tm25ray");
  }

  std::string fault(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const core::ConfigError& error) {
      EXPECT_EQ(error.faults().size(), 1u);
      return error.what();
    }
    return "none";
  }

  TempFolder folder_;
};

Tm25 good() {
  Tm25 file;
  file.rays = {ray(0, 0, 0, 10, 20, 1), ray(1, 0, 0, 30, 40, 2)};
  return file;
}

TEST_F(Tm25HeadTest, LuminousRays) {
  const auto layout = read(good().bytes());
  EXPECT_EQ(layout.format, "tm25");
  EXPECT_EQ(layout.rays, 2u);
  EXPECT_EQ(layout.first_byte, 36288u);
  EXPECT_EQ(layout.columns, 7);
  EXPECT_EQ(layout.flux, 6);
  EXPECT_TRUE(layout.lumens);
  EXPECT_FALSE(layout.stokes);
  EXPECT_FALSE(layout.head_flux);
  EXPECT_EQ(layout.mm_per_unit, 1.0);
}

TEST_F(Tm25HeadTest, AllColumnsTablesItemsAndText) {
  Tm25 file;
  file.luminous = 12.5F;
  file.flags = {1, 1, 1, 1, 1, 1, 1, 1};
  file.spectral = 4;
  file.tables = {{400, 1, 500, 2, 600, 1}, {450, 1}};  // 28 + 12 bytes, filled up to 64
  file.items = 2;
  file.text_bytes = 32;
  file.rays = {RayNumbers(20, 0.5F)};
  const auto layout = read(file.bytes());
  EXPECT_EQ(layout.first_byte, 36288u + 64u + 2u * 512u + 32u);
  EXPECT_EQ(layout.columns, 20);
  EXPECT_EQ(layout.flux, 8);  // after radiant flux and wavelength
  EXPECT_TRUE(layout.lumens);
  EXPECT_EQ(layout.stokes, 9);
  EXPECT_EQ(layout.head_flux, 12.5);
}

TEST_F(Tm25HeadTest, RadiantRays) {
  Tm25 file = good();
  file.flags = {1, 1, 1, 0, 0, 0, 0, 0};
  EXPECT_FALSE(read(file.bytes()).lumens);
  EXPECT_EQ(read(file.bytes()).flux, 6);
}

TEST_F(Tm25HeadTest, Faults) {
  const auto with = [](auto change) {
    Tm25 file = good();
    change(file);
    return file.bytes();
  };
  const std::string bytes = good().bytes();
  EXPECT_EQ(fault(bytes), "none");
  EXPECT_THAT(fault(""), HasSubstr("must be at least 36288 bytes long"));
  EXPECT_THAT(fault(bytes.substr(0, 300)), HasSubstr("must be at least 36288 bytes long"));
  EXPECT_THAT(fault(bytes.substr(0, bytes.size() - 1)), HasSubstr("must hold 2 rays of 28 bytes from byte 36288"));
  EXPECT_THAT(fault(bytes + "x"), HasSubstr("must hold 2 rays of 28 bytes"));
  EXPECT_THAT(fault(with([](auto& f) { f.mark = "TM26"; })), HasSubstr("must begin with TM25"));
  EXPECT_THAT(fault(with([](auto& f) { f.version = 2020; })), HasSubstr("version: must be 2013 (TM-25-13), got 2020"));
  EXPECT_THAT(fault(with([](auto& f) { f.told_rays = 3; })), HasSubstr("must hold 3 rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.told_rays = std::uint64_t{1} << 63; })),
              HasSubstr("must hold 9223372036854775808"));
  EXPECT_THAT(fault(with([](auto& f) { f.rays.clear(); })), HasSubstr("must hold 0 rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.flags[0] = 0; })), HasSubstr("position flag: must lie in [1, 1], got 0"));
  EXPECT_THAT(fault(with([](auto& f) { f.flags[4] = 7; })), HasSubstr("luminous flux flag: must lie in [0, 1]"));
  EXPECT_THAT(fault(with([](auto& f) { f.flags[4] = 0; })), HasSubstr("radiant or the luminous flux"));
  EXPECT_THAT(fault(with([](auto& f) { f.luminous = -1; })), HasSubstr("luminous flux: must not be negative"));
  EXPECT_THAT(fault(with([](auto& f) { f.spectral = 9; })), HasSubstr("spectral data identifier"));
  EXPECT_THAT(fault(with([](auto& f) { f.told_tables = 100; })), HasSubstr("spectral table"));
  EXPECT_THAT(fault(with([](auto& f) { f.told_tables = 2000000000; })), HasSubstr("number of spectral tables"));
  EXPECT_THAT(fault(with([](auto& f) { f.items = 100000; })), HasSubstr("number of additional items"));
  std::string text = bytes;
  text.replace(84, 4, std::string("\0\0\0\x7f", 4));
  EXPECT_THAT(fault(text), HasSubstr("size of the additional text"));
}

}  // namespace
}  // namespace evenglow::tests

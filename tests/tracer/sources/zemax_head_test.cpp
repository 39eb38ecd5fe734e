#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/ray_files.h"
#include "tests/support/temp_folder.h"
#include "tracer/sources/ray_file_layout.h"

namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

class ZemaxHeadTest : public ::testing::Test {
 protected:
  tracer::RayFileLayout read(const std::string& bytes, const std::string& format = "zemax") {
    write_text(folder_ / "led.dat", bytes);
    return tracer::read_ray_file_head(folder_ / "led.dat", format);
  }

  std::string fault(const std::string& bytes, const std::string& format = "zemax") {
    try {
      read(bytes, format);
    } catch (const core::ConfigError& error) {
      EXPECT_EQ(error.faults().size(), 1u);
      return error.what();
    }
    return "none";
  }

  TempFolder folder_;
};

Zemax good() {
  Zemax file;
  file.rays = {ray(0, 0, 0, 10, 20, 1), ray(1, 0, 0, 30, 40, 2)};
  return file;
}

TEST_F(ZemaxHeadTest, FluxOnlyInLumens) {
  ASSERT_EQ(good().bytes().size(), 208u + 2 * 28u);
  const auto layout = read(good().bytes());
  EXPECT_EQ(layout.format, "zemax");
  EXPECT_EQ(layout.rays, 2u);
  EXPECT_EQ(layout.first_byte, 208u);
  EXPECT_EQ(layout.columns, 7);
  EXPECT_TRUE(layout.lumens);
  EXPECT_EQ(layout.mm_per_unit, 1.0);
}

TEST_F(ZemaxHeadTest, SpectralColorIsInWatts) {
  Zemax file = good();
  file.format = 2;
  file.identifier = 8675309;
  for (RayNumbers& numbers : file.rays) numbers.push_back(0.55F);
  const auto layout = read(file.bytes());
  EXPECT_EQ(layout.columns, 8);
  EXPECT_FALSE(layout.lumens);
}

TEST_F(ZemaxHeadTest, Units) {
  Zemax file = good();
  const double expected[] = {1000.0, 25.4, 10.0, 304.8, 1.0};
  for (int unit = 0; unit < 5; ++unit) {
    file.unit = unit;
    EXPECT_EQ(read(file.bytes()).mm_per_unit, expected[unit]);
  }
}

TEST_F(ZemaxHeadTest, TheFormatIsToldByTheFirstBytes) {
  EXPECT_EQ(read(good().bytes(), "auto").format, "zemax");
  Tm25 tm25;
  tm25.rays = {ray(0, 0, 0, 10, 20, 1)};
  EXPECT_EQ(read(tm25.bytes(), "auto").format, "tm25");
  EXPECT_THAT(fault("hello world", "auto"), HasSubstr("must be a TM-25 or Zemax ray file, got neither's mark"));
  EXPECT_THAT(fault("x", "auto"), HasSubstr("less than 4 bytes"));
  EXPECT_THAT(fault(tm25.bytes(), "zemax"), HasSubstr("identifier 1010 or 8675309"));
}

TEST_F(ZemaxHeadTest, Faults) {
  const auto with = [](auto change) {
    Zemax file = good();
    change(file);
    return file.bytes();
  };
  const std::string bytes = good().bytes();
  EXPECT_EQ(fault(bytes), "none");
  EXPECT_THAT(fault(bytes.substr(0, 100)), HasSubstr("must be at least 208 bytes long"));
  EXPECT_THAT(fault(bytes.substr(0, 230)), HasSubstr("must hold 2 rays of 28 bytes from byte 208 to its end, got 22"));
  EXPECT_THAT(fault(bytes + "tail"), HasSubstr("must hold 2 rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.told_rays = 4000000000U; })), HasSubstr("must hold 4000000000 rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.rays.clear(); })), HasSubstr("must hold 0 rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.identifier = 7; })), HasSubstr("got 7"));
  EXPECT_THAT(fault(with([](auto& f) { f.unit = 5; })), HasSubstr("unit of length: must lie in [0, 4], got 5"));
  EXPECT_THAT(fault(with([](auto& f) { f.format = 1; })), HasSubstr("format of the rays"));
  EXPECT_THAT(fault(with([](auto& f) { f.kind = -1; })), HasSubstr("kind of flux"));
  // Eight numbers a ray told, seven given.
  EXPECT_THAT(fault(with([](auto& f) { f.format = 2; })), HasSubstr("must hold 2 rays of 32 bytes"));
}

}  // namespace
}  // namespace evenglow::tests

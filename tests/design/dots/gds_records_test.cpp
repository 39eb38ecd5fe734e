#include "design/dots/gds_records.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::tests {
namespace {

using design::gds_real;
using design::GdsRecords;

/// The format's reals read back: (-1)^sign fraction 16^(power - 64).
double value_of(std::uint64_t real) {
  const double fraction = std::ldexp(static_cast<double>(real & 0x00ffffffffffffff), -56);
  const int power = static_cast<int>(real >> 56 & 0x7f) - 64;
  return (real >> 63 != 0 ? -1.0 : 1.0) * fraction * std::pow(16.0, power);
}

TEST(GdsReal, KnownNumbers) {
  EXPECT_EQ(gds_real(0.0), 0u);
  EXPECT_EQ(gds_real(1.0), 0x4110000000000000u);
  EXPECT_EQ(gds_real(-2.0), 0xC120000000000000u);
  EXPECT_EQ(gds_real(1e-3), 0x3E4189374BC6A7F0u);  // user unit of files in um
  EXPECT_EQ(gds_real(1e-9), 0x3944B82FA09B5A54u);  // database unit of 1 nm
}

TEST(GdsReal, ReadsBackAsTheNumber) {
  for (const double value : {1e-12, 0.0625, 0.999999999999999, 15.9999, 16.0, 1234.5, -3.25e7})
    EXPECT_NEAR(value_of(gds_real(value)) / value, 1.0, 1e-15) << value;
}

TEST(GdsRecords, LengthTypeAndDataBigEndian) {
  GdsRecords records;
  records.add(GdsRecords::Type::header, std::vector<std::int16_t>{600});
  records.add(GdsRecords::Type::library_name, "odd");
  records.add(GdsRecords::Type::points, std::vector<std::int32_t>{-1});
  records.add(GdsRecords::Type::end_library);
  const std::string expected(
      "\x00\x06\x00\x02\x02\x58"
      "\x00\x08\x02\x06odd\x00"
      "\x00\x08\x10\x03\xff\xff\xff\xff"
      "\x00\x04\x04\x00",
      26);
  EXPECT_EQ(records.bytes(), expected);
  records.clear();
  EXPECT_TRUE(records.bytes().empty());
}

}  // namespace
}  // namespace evenglow::tests

#include "core/config/number_text.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::core {
namespace {

ConfigValue scalar(const std::string& text, bool quoted = false) {
  ConfigValue value;
  value.kind = ConfigValue::Kind::kScalar;
  value.quoted = quoted;
  value.text = text;
  return value;
}

TEST(ParseNumber, TakesWhatYamlCallsANumber) {
  EXPECT_EQ(parse_number(scalar("-1.5")).value, -1.5);
  EXPECT_EQ(parse_number(scalar("+.5")).value, 0.5);
  EXPECT_EQ(parse_number(scalar("20e6")).value, 20e6);
  EXPECT_EQ(parse_number(scalar("7.")).value, 7.0);
}

TEST(ParseNumber, TellsWhatIsWrong) {
  EXPECT_EQ(parse_number(scalar("5", true)).fault, "must be a number without quotes, got \"5\"");
  EXPECT_EQ(parse_number(scalar("1,5")).fault, "must be a number with a decimal point, got 1,5");
  EXPECT_EQ(parse_number(scalar(".nan")).fault, "must be a finite number, got .nan");
  EXPECT_EQ(parse_number(scalar("-.INF")).fault, "must be a finite number, got -.INF");
  EXPECT_EQ(parse_number(scalar("0x1F")).fault, "must be a decimal number, got 0x1F");
  EXPECT_EQ(parse_number(scalar("017")).fault, "must be a number without leading zeros, got 017");
  EXPECT_EQ(parse_number(scalar("1e999")).fault, "must be a number that a computer's number can hold, got 1e999");
  for (const char* text : {"", ".", "e5", "1e", "1.2.3", "5 mm", "--1", "1_000"})
    EXPECT_FALSE(parse_number(scalar(text)).value) << text;
}

TEST(ParseInteger, WholeNumbersAlone) {
  EXPECT_EQ(parse_integer(scalar("-12"), false).value, -12);
  EXPECT_EQ(parse_integer(scalar("2.5e6"), true).value, 2'500'000);
  EXPECT_FALSE(parse_integer(scalar("2e6"), false).value);
  EXPECT_FALSE(parse_integer(scalar("2.5"), true).value);
  EXPECT_FALSE(parse_integer(scalar("1e18"), true).value);
  EXPECT_EQ(parse_integer(scalar("99999999999999999999"), true).fault,
            "must be a whole number of at most 18 digits, got 99999999999999999999");
}

TEST(ParseBoolean, TrueAndFalseAlone) {
  EXPECT_EQ(parse_boolean(scalar("True")).value, true);
  EXPECT_EQ(parse_boolean(scalar("false")).value, false);
  EXPECT_EQ(parse_boolean(scalar("yes")).fault, "must be true or false, got yes");
  EXPECT_FALSE(parse_boolean(scalar("true", true)).value);
}

TEST(Units, AreThoseThatTheKeyEndsIn) {
  EXPECT_EQ(unit_of("length_mm"), "mm");
  EXPECT_EQ(unit_of("absorption_per_m"), "per_m");
  EXPECT_EQ(unit_of("scattering_per_mm"), "per_mm");
  EXPECT_EQ(unit_of("mm"), "");
  EXPECT_EQ(unit_of("film"), "");
  EXPECT_EQ(to_internal("diameter_um", 25.0), 0.025);
  EXPECT_EQ(to_internal("absorption_per_m", 2.0), 0.002);
  EXPECT_DOUBLE_EQ(to_internal("axis_deg", 180.0), kPi);
  EXPECT_EQ(to_internal("haze", 0.5), 0.5);
}

TEST(Requirement, TellsTheRange) {
  EXPECT_EQ(requirement(Range{0.0, 180.0, false, true}), "must lie in [0, 180)");
  EXPECT_EQ(requirement(Range::positive()), "must be greater than 0");
  EXPECT_EQ(requirement(Range{1.0}), "must be at least 1");
  EXPECT_EQ(requirement(Range::any()), "must be a number");
  EXPECT_EQ(requirement(2, 10), "must lie in [2, 10]");
  EXPECT_EQ(requirement(2, std::numeric_limits<long long>::max()), "must be at least 2");
}

TEST(SomeNumber, IsOfTheRange) {
  for (const Range& range : {Range{0.0, 180.0, false, true}, Range::positive(), Range{1.0}, Range::any(),
                             Range{-std::numeric_limits<double>::infinity(), -3.0}})
    EXPECT_TRUE(range.contains(some_number(range))) << range.to_string();
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  for (const double value : {0.1, 1e300, -5.0, 1.0 / 3.0}) EXPECT_EQ(std::stod(number_text(value)), value);
}

}  // namespace
}  // namespace evenglow::core

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/config/config_node.h"
#include "tests/core/config_reading.h"

namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Range kAngle{0, 180, false, true};

Reader reads(const std::function<void(const ConfigNode&)>& read) {
  return read;
}

struct NumberCase {
  const char* yaml;
  const char* fault;  ///< empty: accepted
  double value = 0;
};

class NumberForms : public ::testing::TestWithParam<NumberCase> {};

TEST_P(NumberForms, AreAcceptedOrRefusedWithAReason) {
  const NumberCase& given = GetParam();
  double value = 0;
  const Lines faults = faults_of(std::string("x: ") + given.yaml, [&](const ConfigNode& node) {
    value = node.number({"x", "a number", Range::any(), {}});
  });
  if (std::string(given.fault).empty()) {
    EXPECT_THAT(faults, IsEmpty());
    EXPECT_EQ(value, given.value);
  } else {
    const bool null_value = std::string(given.fault).ends_with("got nothing");
    EXPECT_THAT(faults, ElementsAre(std::string(null_value ? "run.yaml:1:1: x: " : "run.yaml:1:4: x: ") + given.fault));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Yaml12Core, NumberForms,
    ::testing::Values(
        NumberCase{"5", "", 5}, NumberCase{"-5", "", -5}, NumberCase{"+5", "", 5}, NumberCase{"1.5", "", 1.5},
        NumberCase{".5", "", 0.5}, NumberCase{"5.", "", 5}, NumberCase{"20e6", "", 20e6},
        NumberCase{"-2.5E-3", "", -2.5e-3}, NumberCase{"1e+2", "", 100}, NumberCase{"0", "", 0},
        NumberCase{"0.10", "", 0.1}, NumberCase{".nan", "must be a finite number, got .nan"},
        NumberCase{".NaN", "must be a finite number, got .NaN"}, NumberCase{"nan", "must be a finite number, got nan"},
        NumberCase{".inf", "must be a finite number, got .inf"},
        NumberCase{"-.inf", "must be a finite number, got -.inf"},
        NumberCase{"inf", "must be a finite number, got inf"},
        NumberCase{"1e999", "must be a number that a computer's number can hold, got 1e999"},
        NumberCase{"0x10", "must be a decimal number, got 0x10"},
        NumberCase{"0o17", "must be a decimal number, got 0o17"},
        NumberCase{"017", "must be a number without leading zeros, got 017"},
        NumberCase{"5 mm", "must be a number, got 5 mm"}, NumberCase{"5mm", "must be a number, got 5mm"},
        NumberCase{"0,5", "must be a number with a decimal point, got 0,5"},
        NumberCase{"1_000", "must be a number, got 1_000"},
        NumberCase{"\"5\"", "must be a number without quotes, got \"5\""},
        NumberCase{"'5'", "must be a number without quotes, got \"5\""},
        NumberCase{"true", "must be a number, got true"}, NumberCase{"[5]", "must be a number, got a list"},
        NumberCase{"{a: 5}", "must be a number, got a map"}, NumberCase{"", "must be a number, got nothing"},
        NumberCase{"null", "must be a number, got nothing"}, NumberCase{"~", "must be a number, got nothing"},
        NumberCase{".", "must be a number, got ."}, NumberCase{"1e", "must be a number, got 1e"},
        NumberCase{"--5", "must be a number, got --5"}));

struct UnitCase {
  const char* key;
  double in_file;
  double inside;
};

class KeyUnits : public ::testing::TestWithParam<UnitCase> {};

TEST_P(KeyUnits, AreConvertedOnceAndCheckedInTheUnitOfTheFile) {
  const auto& [key, in_file, inside] = GetParam();
  const Range range = Range::closed(in_file - 1, in_file);
  const std::string text = std::string(key) + ": " + std::to_string(in_file);
  EXPECT_THAT(faults_of(text,
                        [&](const ConfigNode& node) {
                          EXPECT_EQ(node.number({key, "", range, {}}), inside);
                        }),
              IsEmpty());
  EXPECT_THAT(faults_of("{}",
                        [&](const ConfigNode& node) {
                          EXPECT_EQ(node.number({key, "", range, in_file}), inside);
                        }),
              IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Suffixes, KeyUnits,
                         ::testing::Values(UnitCase{"a_mm", 140, 140}, UnitCase{"a_um", 25, 0.025},
                                           UnitCase{"a_um", 35, 0.035}, UnitCase{"a_deg", 90, kPi / 2},
                                           UnitCase{"se_deg", 180, kPi}, UnitCase{"a_lm", 9, 9},
                                           UnitCase{"a_nm", 550, 550}, UnitCase{"a_per_m", 3, 0.003},
                                           UnitCase{"a_per_mm", 3, 3}, UnitCase{"mm", 3, 3}, UnitCase{"alum", 3, 3},
                                           UnitCase{"reflectance", 2, 2}));

struct RangeCase {
  Range range;
  const char* given;
  const char* message;  ///< empty: accepted
};

class Ranges : public ::testing::TestWithParam<RangeCase> {};

TEST_P(Ranges, AreCheckedAtTheirEnds) {
  const auto& [range, given, message] = GetParam();
  double value = 0;
  const Lines faults = faults_of(std::string("x: ") + given, [&](const ConfigNode& node) {
    value = node.number({"x", "", range, {}});
  });
  EXPECT_TRUE(range.contains(value)) << "after a fault the read goes on inside the range";
  const bool accepted = std::string(message).empty();
  EXPECT_EQ(faults, accepted ? Lines{} : Lines{std::string("run.yaml:1:4: x: ") + message});
}

INSTANTIATE_TEST_SUITE_P(
    Ends, Ranges,
    ::testing::Values(RangeCase{kAngle, "0", ""}, RangeCase{kAngle, "180", "must lie in [0, 180), got 180"},
                      RangeCase{kAngle, "-1e-9", "must lie in [0, 180), got -1e-9"},
                      RangeCase{Range::positive(2), "0", "must lie in (0, 2], got 0"},
                      RangeCase{Range::positive(2), "2", ""},
                      RangeCase{Range::positive(), "0", "must be greater than 0, got 0"},
                      RangeCase{Range{1}, "0.5", "must be at least 1, got 0.5"},
                      RangeCase{Range{-std::numeric_limits<double>::infinity(), 4}, "5", "must be at most 4, got 5"},
                      RangeCase{Range{-std::numeric_limits<double>::infinity(), 4, false, true}, "4",
                                "must be less than 4, got 4"}));

TEST(Range, IsWrittenAsInMathematics) {
  EXPECT_EQ(kAngle.to_string(), "[0, 180)");
  EXPECT_EQ(Range::positive().to_string(), "(0, inf)");
  EXPECT_EQ(Range::any().to_string(), "(-inf, inf)");
  EXPECT_EQ(Range::closed(-0.5, 1e-3).to_string(), "[-0.5, 0.001]");
}

TEST(ConfigNode, OptionalNumberIsNoneWhenAbsent) {
  EXPECT_THAT(faults_of("a_mm: 2", reads([](const ConfigNode& node) {
                          EXPECT_EQ(node.optional_number({"a_mm", "", Range::any(), {}}), 2.0);
                          EXPECT_EQ(node.optional_number({"b_mm", "", Range::any(), 7.0}), std::nullopt);
                        })),
              IsEmpty());
}

struct IntegerCase {
  const char* given;
  bool count;
  const char* message;  ///< empty: accepted
  long long value = 0;
};

class Integers : public ::testing::TestWithParam<IntegerCase> {};

TEST_P(Integers, AreWholeAndFit) {
  const IntegerCase& given = GetParam();
  long long value = 0;
  const Lines faults = faults_of(std::string("n: ") + given.given, [&](const ConfigNode& node) {
    const IntegerKey key{"n", "", 0, std::numeric_limits<long long>::max(), {}};
    value = given.count ? node.count(key) : node.integer(key);
  });
  const bool accepted = std::string(given.message).empty();
  EXPECT_EQ(faults, accepted ? Lines{} : Lines{std::string("run.yaml:1:4: n: ") + given.message});
  EXPECT_EQ(value, accepted ? given.value : 1) << "after a fault: some number of the range";
}

INSTANTIATE_TEST_SUITE_P(
    Forms, Integers,
    ::testing::Values(
        IntegerCase{"12", false, "", 12}, IntegerCase{"9223372036854775807", false, "", 9223372036854775807LL},
        IntegerCase{"1.5", false, "must be a whole number, got 1.5"},
        IntegerCase{"5.0", false, "must be a whole number, got 5.0"},
        IntegerCase{"20e6", false, "must be a whole number, got 20e6"},
        IntegerCase{"9223372036854775808", false,
                    "must be a whole number of at most 18 digits, got 9223372036854775808"},
        IntegerCase{"-1", false, "must be at least 0, got -1"},
        IntegerCase{"0x1F", false, "must be a decimal number, got 0x1F"}, IntegerCase{"20e6", true, "", 20000000},
        IntegerCase{"2.5e6", true, "", 2500000}, IntegerCase{"7", true, "", 7},
        IntegerCase{"1.5", true, "must be a whole number (20e6 is one too), got 1.5"},
        IntegerCase{"1e30", true, "must be a whole number of at most 18 digits, got 1e30"},
        IntegerCase{"1e400", true, "must be a whole number of at most 18 digits, got 1e400"},
        IntegerCase{"-2e3", true, "must be at least 0, got -2e3"},
        IntegerCase{"\"7\"", true, "must be a whole number (20e6 is one too) without quotes, got \"7\""}));

TEST(ConfigNode, IntegerRangeIsToldWhole) {
  EXPECT_THAT(faults_of("n: 9", reads([](const ConfigNode& node) {
                          node.integer({"n", "", 1, 8, {}});
                        })),
              ElementsAre("run.yaml:1:4: n: must lie in [1, 8], got 9"));
}

TEST(ConfigNode, BooleansAreTrueAndFalseOnly) {
  const Reader read = [](const ConfigNode& node) { node.boolean({"b", "", {}}); };
  for (const char* word : {"true", "True", "FALSE", "false"})
    EXPECT_THAT(faults_of(std::string("b: ") + word, read), IsEmpty());
  EXPECT_THAT(faults_of("b: yes", read), ElementsAre("run.yaml:1:4: b: must be true or false, got yes"));
  EXPECT_THAT(faults_of("b: 'true'", read), ElementsAre("run.yaml:1:4: b: must be true or false, got \"true\""));
  EXPECT_THAT(faults_of("b: 1", read), ElementsAre("run.yaml:1:4: b: must be true or false, got 1"));
}

TEST(ConfigNode, TextsMayLookLikeNumbersButNotBeAbsent) {
  const Reader read = [](const ConfigNode& node) { node.text({"t", "the title", {}, 10}); };
  EXPECT_THAT(faults_of("t: 6", read), IsEmpty());
  EXPECT_THAT(faults_of("t: ''", read), IsEmpty());
  EXPECT_THAT(faults_of("t:", read), ElementsAre("run.yaml:1:1: t: must be text, got nothing"));
  EXPECT_THAT(faults_of("t: [a]", read), ElementsAre("run.yaml:1:4: t: must be text, got a list"));
  EXPECT_THAT(faults_of("t: 12345678901", read),
              ElementsAre("run.yaml:1:4: t: must not be longer than 10 bytes, got 11"));
  EXPECT_THAT(faults_of("{}", read), ElementsAre("run.yaml:1:1: t: must be given (the title)"));
}

TEST(ConfigNode, ChoicesNameTheOptionsAndTheNearest) {
  const Reader read = [](const ConfigNode& node) { node.choice({"c", "", {"printed_dot", "cone"}, {}}); };
  EXPECT_THAT(faults_of("c: cone", read), IsEmpty());
  EXPECT_THAT(faults_of("c: con", read),
              ElementsAre("run.yaml:1:4: c: must be one of printed_dot, cone; got con, did you mean `cone`?"));
  EXPECT_THAT(faults_of("c: 7", read), ElementsAre("run.yaml:1:4: c: must be one of printed_dot, cone; got 7"));
  EXPECT_THAT(faults_of("c:", read), ElementsAre("run.yaml:1:1: c: must be one of printed_dot, cone; got nothing"));
}

TEST(ConfigNode, GivenValuesAreCutAndKeptOnOneLine) {
  const Reader read = [](const ConfigNode& node) { node.number({"x", "", Range::any(), {}}); };
  EXPECT_THAT(faults_of("x: \"a\\nb\\x1b[31m\\u2028\\0\"", read),
              ElementsAre("run.yaml:1:4: x: must be a number without quotes, got \"a\\nb\\x1b[31m\\u2028\\x00\""));
  EXPECT_THAT(faults_of("x: " + std::string(5000, 'y'), read),
              ElementsAre("run.yaml:1:4: x: must be a number, got " + std::string(60, 'y') + "..."));
  const Lines umlauts = faults_of(
      "x: a" +
          []() {
            std::string text;
            for (int i = 0; i < 100; ++i) text += "\xc3\xbc";
            return text;
          }(),
      read);
  ASSERT_EQ(umlauts.size(), 1u);
  EXPECT_TRUE(umlauts[0].ends_with("\xc3\xbc...")) << umlauts[0];
}

}  // namespace
}  // namespace evenglow::core

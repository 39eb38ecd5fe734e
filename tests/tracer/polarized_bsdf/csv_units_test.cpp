#include "tracer/polarized_bsdf/csv_units.h"

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

std::string fault(const std::string& text, bool required = true) {
  const auto found = unit_fault(text, "f.csv", required);
  return found ? found->to_string() : "";
}

constexpr const char* kAllowed = "f.csv:1:1: the comment must name the units degrees, nm and 1/sr";

TEST(CsvUnits, TakesTheUsualSpellings) {
  EXPECT_EQ(fault("# angles in degrees, wavelength in nm, tau in 1/sr\na,b\n"), "");
  EXPECT_EQ(fault("# deg, nanometers, sr^-1\n"), "");
  EXPECT_EQ(fault("# \xC2\xB0; nm; sr-1\n"), "");
  EXPECT_EQ(fault("\xEF\xBB\xBF# Deg, NM, 1/SR\n"), "") << "byte order mark, capitals";
  EXPECT_EQ(fault("# a film\n# degrees and nm\n# 1/sr\n"), "") << "several lines";
}

TEST(CsvUnits, NamesTheUnitThatIsMissing) {
  EXPECT_EQ(fault("# nm, 1/sr\n"), std::string(kAllowed) + ", got one without degrees");
  EXPECT_EQ(fault("# degrees, 1/sr\n"), std::string(kAllowed) + ", got one without nm");
  EXPECT_EQ(fault("# degrees, nm\n"), std::string(kAllowed) + ", got one without 1/sr");
  EXPECT_EQ(fault("a,b\n1,2\n"), std::string(kAllowed) + " on the first line, got none");
}

TEST(CsvUnits, NamesOtherUnitsAndTheirLine) {
  EXPECT_EQ(fault("# degrees, nm, 1/sr\n# psi in radians\n"),
            "f.csv:2:1: the comment must name the units degrees, nm and 1/sr, got 'radians'");
  for (const char* unit : {"rad", "mrad", "um", "\xC2\xB5m", "angstrom", "gon"}) {
    EXPECT_EQ(fault(std::string("# degrees, nm, 1/sr, ") + unit + "\n"),
              std::string(kAllowed) + ", got '" + unit + "'");
  }
  EXPECT_EQ(fault("# degrees, nm, cd/m2\n"), std::string(kAllowed) + ", got 'cd/m2'");
  EXPECT_EQ(fault("# degrees, nm, percent\n"), std::string(kAllowed) + ", got 'percent'");
  EXPECT_EQ(fault("# degrees, nm, 1/sr from readings of 1 percent noise\n"), "") << "beside 1/sr it is no unit";
}

TEST(CsvUnits, WhatIsNotRequiredMayBeMissingButNotWrong) {
  EXPECT_EQ(fault("a,b\n", false), "");
  EXPECT_EQ(fault("# a film\n", false), "");
  EXPECT_NE(fault("# radians\n", false), "");
}

TEST(CsvUnits, MillimetersAreWrongForTheWavelengthOnly) {
  for (const bool required : {false, true}) {
    EXPECT_EQ(fault("# degrees, mm, 1/sr\n", required), std::string(kAllowed) + ", got 'mm'");
    EXPECT_EQ(fault("# film of 0.3 mm; degrees, nm, 1/sr\n", required), "");
  }
  EXPECT_EQ(fault("# film of 0.3 mm\n", false), "") << "names no units";
}

TEST(CsvUnits, OnlyTheCommentAboveTheHeaderCounts) {
  EXPECT_EQ(fault("# degrees, nm, 1/sr\na,b\n# radians\n1,2\n"), "");
  EXPECT_EQ(fault("# degraded film, radius 3, nm, degrees, 1/sr\n"), "") << "words are whole";
}

}  // namespace
}  // namespace evenglow::tracer

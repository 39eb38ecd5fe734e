#include "tracer/films/film_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

TEST(FilmKeys, GapAndAxisInOurUnits) {
  const auto document = core::ConfigDocument::parse("gap_mm: 0.3\naxis_deg: 90\n", "f.yaml");
  const Film film = film_of("some", document.root());
  EXPECT_EQ(film.kind, "some");
  EXPECT_EQ(film.gap, 0.3);
  EXPECT_NEAR(axis_of(document.root()), core::kPi / 2, 1e-15);
  document.finish();
}

TEST(FilmKeys, SumAboveOneIsAFaultAndIsLowered) {
  const auto document = core::ConfigDocument::parse("a: 0.7\nb: 0.4\n", "f.yaml");
  const double a = share(document.root(), "a", "whole", 0.0);
  double b = share(document.root(), "b", "part", 0.0);
  require_sum(document.root(), a, "a", b, "b");
  EXPECT_NEAR(b, 0.3, 1e-15);
  try {
    document.finish();
    FAIL();
  } catch (const core::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("f.yaml:2:4: b: must be at most 1 - a = 0.3, got 0.4"));
  }
}

}  // namespace
}  // namespace evenglow::tracer

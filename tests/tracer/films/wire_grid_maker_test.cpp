#include "tracer/films/wire_grid_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/film_yaml.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::film_faults;
using tests::film_from;

TEST(WireGridMaker, ReadsItsKeys) {
  const Film film = film_from(
      "{kind: wire_grid, axis_deg: 90, gap_mm: 0.2, transmittance_pass: 0.8, reflectance_pass: 0.1, extinction: 100, "
      "reflectance_block: 0.85}");
  EXPECT_EQ(film.gap, 0.2);
  EXPECT_EQ(film.axis_index, 1.0);
  const auto s = film.surface->specular(tests::travel(0, 0));
  // Pass axis y: at normal incidence e1 is x, so Q = -1 passes.
  EXPECT_NEAR((s.transmission * Eigen::Vector4d(1, -1, 0, 0))[0], 0.8, 1e-12);
  EXPECT_NEAR((s.reflection * Eigen::Vector4d(1, -1, 0, 0))[0], 0.1, 1e-12);
  EXPECT_NEAR((s.transmission * Eigen::Vector4d(1, 1, 0, 0))[0], 0.008, 1e-12);
  EXPECT_NEAR((s.reflection * Eigen::Vector4d(1, 1, 0, 0))[0], 0.85, 1e-12);
}

TEST(WireGridMaker, ChangedKeysDoNotFaultTheDefaults) {
  EXPECT_EQ(film_faults("{kind: wire_grid, transmittance_pass: 0.99}"), "accepted");
  EXPECT_EQ(film_faults("{kind: wire_grid, extinction: 2}"), "accepted");
}

TEST(WireGridMaker, NamesFaults) {
  EXPECT_THAT(film_faults("{kind: wire_grid, transmittance_pass: 0.9, reflectance_pass: 0.2}"),
              HasSubstr("reflectance_pass: must be at most"));
  EXPECT_THAT(film_faults("{kind: wire_grid, extinction: 2, reflectance_block: 0.9}"),
              HasSubstr("reflectance_block: must be at most 1 - transmittance_pass / extinction"));
  EXPECT_THAT(film_faults("{kind: wire_grid, extinction: 0.5}"), HasSubstr("extinction"));
}

}  // namespace
}  // namespace evenglow::tracer

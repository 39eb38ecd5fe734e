#include "design/dots/lattice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

core::CellField even(double coverage) {
  return core::CellField(core::CellGrid::over(16, 8, 0.0, 0.0, 20.0, 10.0), coverage);
}

DotSpec lattice_spec(DotLattice kind) {
  DotSpec spec;
  spec.mode = DotMode::lattice;
  spec.lattice = kind;
  spec.pitch = 0.1;
  return spec;
}

TEST(Lattice, AreaOfAPlace) {
  EXPECT_DOUBLE_EQ(lattice_place_area(lattice_spec(DotLattice::square)), 0.01);
  EXPECT_DOUBLE_EQ(lattice_place_area(lattice_spec(DotLattice::hexagonal)), 0.01 * std::sqrt(0.75));
}

TEST(Lattice, PitchAndGapLimitTheDiameter) {
  DotSpec spec = lattice_spec(DotLattice::square);
  EXPECT_NEAR(greatest_lattice_diameter(spec), 0.09, 1e-12);
  spec.footprint = core::Footprint::square;
  EXPECT_NEAR(greatest_lattice_diameter(spec), 0.0635, 1e-12);  // 0.09 / sqrt(2), whole steps of 0.5 um
  spec.diameter_max = 0.05;
  EXPECT_DOUBLE_EQ(greatest_lattice_diameter(spec), 0.05);
}

/// One dot a place, nearest neighbors at the pitch, the area that the coverage asks for.
TEST(Lattice, DotsStandOnTheLatticeWithTheAreaAskedFor) {
  for (const DotLattice kind : {DotLattice::square, DotLattice::hexagonal}) {
    DotSpec spec = lattice_spec(kind);
    spec.lattice_angle = 0.3;
    const DotStore store = lattice_dots(spec, {even(0.2), whole_plate()});
    EXPECT_NEAR(static_cast<double>(store.size()) * lattice_place_area(spec), 200.0, 3.0);
    const auto& dots = store.dots();
    const double diameter = std::sqrt(0.2 * lattice_place_area(spec) * 4.0 / 3.14159265358979);
    for (std::size_t i = 0; i < store.size(); i += 97) {
      ASSERT_NEAR(static_cast<double>(dots.diameter[i]), diameter, 1e-6);
      double least = 1.0;
      store.near(dots.x[i], dots.y[i], 0.12, [&](std::size_t j) {
        if (j != i) least = std::min(least, std::hypot(dots.x[i] - dots.x[j], dots.y[i] - dots.y[j]));
      });
      ASSERT_NEAR(least, spec.pitch, 1e-9);
    }
  }
}

/// Coverage 0.03 of places of 0.01 mm2 is less than the least dot of 30 um (0.000707 mm2): so many fewer places. The
/// strip of half a pitch at the borders (1.5 % of the plate) holds none, and a cell rounds to whole dots (up to 0.8 %).
TEST(Lattice, LeastDotsStandAtFewerPlaces) {
  const DotSpec spec = lattice_spec(DotLattice::square);
  const DotStore store = lattice_dots(spec, {even(0.03), whole_plate()});
  const double least = core::footprint_area(core::Footprint::round, spec.diameter_min);
  EXPECT_NEAR(static_cast<double>(store.size()) * least / (0.03 * 200.0), 0.977, 0.015);
  for (std::size_t i = 0; i < store.size(); ++i) ASSERT_FLOAT_EQ(store.dots().diameter[i], 0.03f);
}

}  // namespace
}  // namespace evenglow::tests

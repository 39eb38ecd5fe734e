#include "design/report/hdf5_map_writer.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/design/metrology_samples.h"
#include "tracer/polarized_bsdf/hdf5_reader.h"

namespace evenglow::design {
namespace {

using tracer::Hdf5Reader;

constexpr std::size_t kMost = 10000;

TEST(Hdf5MapWriter, ReadsBackAsItWas) {
  Report r = samples::report_with_metrology("dbef");
  r.target = samples::ramp(6, 4, 1.0);
  const Hdf5Reader file(hdf5_maps(r), "maps.h5");
  EXPECT_EQ(file.text("", "format"), "evenglow-maps");
  EXPECT_EQ(file.integer("", "format_version"), 1);
  EXPECT_EQ(file.text("", "title"), "sample");
  EXPECT_EQ(file.text("", "variant"), "dbef");
  EXPECT_EQ(file.text("", "seed"), "7");
  for (const NamedMap& map : named_maps(r)) {
    ASSERT_TRUE(file.has(map.name)) << map.name;
    EXPECT_EQ(file.shape(map.name), (std::vector<std::size_t>{static_cast<std::size_t>(map.field.grid.ny),
                                                              static_cast<std::size_t>(map.field.grid.nx)}));
    EXPECT_EQ(file.text(map.name, "unit"), map.unit);
    EXPECT_EQ(file.text(map.name, "axes"), map.name == "density" ? "y_2,x_2" : "y,x") << map.name;
    const std::vector<double> values = file.numbers(map.name, kMost);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(map.field.values[i])) {
        EXPECT_TRUE(std::isnan(values[i])) << map.name;
      } else {
        EXPECT_EQ(values[i], map.field.values[i]) << map.name;
      }
    }
  }
}

TEST(Hdf5MapWriter, HasAxesWithUnits) {
  const Hdf5Reader file(hdf5_maps(samples::report()), "maps.h5");
  EXPECT_EQ(file.numbers("x", kMost), (std::vector<double>{1, 3, 5, 7, 9, 11}));
  EXPECT_EQ(file.numbers("y", kMost), (std::vector<double>{0.75, 2.25, 3.75, 5.25}));
  EXPECT_EQ(file.text("x", "unit"), "mm");
  EXPECT_EQ(file.numbers("x_2", kMost).size(), 8U);
  EXPECT_EQ(file.numbers("azimuth_edges", kMost), (std::vector<double>{0, 90, 180, 270, 360}));
  EXPECT_EQ(file.numbers("polar_edges", kMost), (std::vector<double>{0, 30, 60, 90}));
  EXPECT_EQ(file.text("polar_edges", "unit"), "deg");
  EXPECT_EQ(file.shape("angular_luminance"), (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(file.numbers("angular_luminance_se", kMost)[11], 5.0);
}

TEST(Hdf5MapWriter, OfAComparisonHoldsTheRelations) {
  const Comparison comparison = compare_reports("two", "c", {samples::report("lpp"), samples::report("dbef")});
  const Hdf5Reader file(hdf5_maps(comparison), "maps.h5");
  EXPECT_EQ(file.numbers("ratio_dbef_over_lpp", kMost)[7], 1.0);
  EXPECT_EQ(file.text("difference_dbef_minus_lpp", "unit"), "cd/m2");
}

TEST(Hdf5MapWriter, BearsHostileAndEndlessTexts) {
  Report r = samples::report(std::string("a\0b", 3));
  r.title = std::string(300000, '\xff');
  r.command = "</script>\x01";
  EXPECT_NO_THROW(Hdf5Reader(hdf5_maps(r), "maps.h5"));
  EXPECT_NO_THROW(hdf5_maps(Report{}));
}

}  // namespace
}  // namespace evenglow::design

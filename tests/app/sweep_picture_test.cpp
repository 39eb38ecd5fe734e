#include "app/sweep_picture.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace evenglow::app {
namespace {

/// Rows over `count` values of one of the columns.
std::vector<tracer::SweepRow> rows_over(double tracer::SweepRow::*column, int count) {
  std::vector<tracer::SweepRow> rows;
  for (int i = 0; i < count; ++i) {
    tracer::SweepRow row;
    row.*column = 0.1 * i;
    row.transmittance.value = row.specular_transmittance.value = 0.3 + 0.01 * i;
    rows.push_back(row);
  }
  return rows;
}

TEST(SweepPicture, OneAxisOrAnother) {
  const tests::TempFolder folder;
  std::string first;
  for (const auto column : {&tracer::SweepRow::sigma, &tracer::SweepRow::azimuth, &tracer::SweepRow::wavelength}) {
    write_sweep_picture(rows_over(column, 9), "film", folder / "p.png");
    const std::string picture = tests::file_text(folder / "p.png");
    EXPECT_EQ(picture.substr(1, 3), "PNG");
    EXPECT_NE(picture, first) << "the axis has another name";
    first = picture;
  }
}

TEST(SweepPicture, ASinglePointIsDrawn) {
  const tests::TempFolder folder;
  write_sweep_picture(rows_over(&tracer::SweepRow::sigma, 1), "film", folder / "p.png");
  EXPECT_GT(tests::file_text(folder / "p.png").size(), 1000u);
}

}  // namespace
}  // namespace evenglow::app

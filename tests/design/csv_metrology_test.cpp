#include "design/report/csv_metrology.h"

#include <gtest/gtest.h>

#include "design/report/csv_writer.h"
#include "design/report/png_writer.h"
#include "tests/design/metrology_samples.h"

namespace evenglow::design {
namespace {

TEST(CsvMetrology, HotSpotsHaveARowForEachLine) {
  EXPECT_EQ(hot_spots_csv(samples::report_with_metrology().hot_spots),
            "# luminance in front of the LEDs of a row and between them, by distance from their edge\n"
            "source,edge,distance_mm,front_cd_m2,front_se_cd_m2,between_cd_m2,between_se_cd_m2,ratio,ratio_se\n"
            "2,left,0.75,150,2,100,1,1.5,0.025\n"
            "2,left,2.25,101,1,100,1,1.01,0.01\n");
}

TEST(CsvMetrology, SpotsStandBeforeTheirDirections) {
  const std::string text = angular_spots_csv(samples::report_with_metrology().angular_spots);
  EXPECT_NE(text.find("\n1,6,3,0,30,0,90,500,5\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n1,6,3,60,90,270,360,500,5\n"), std::string::npos) << text;
}

TEST(CsvMetrology, FilesOfWhatTheReportHolds) {
  const samples::Folder folder("csv_metrology");
  CsvWriter().write(samples::report_with_metrology(), folder.path());
  PngWriter().write(samples::report_with_metrology(), folder.path());
  for (const char* name : {"color_u.csv", "color_u_se.csv", "color_v.csv", "color_v_se.csv", "delta_uv_se.csv",
                           "hot_spots.csv", "angular_spots.csv", "delta_uv.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  }
  const std::string delta = samples::content(folder.path() / "delta_uv.csv");
  EXPECT_EQ(delta.find("# delta u'v' from the mean color"), 0U);
  EXPECT_NE(delta.find(",nan\n"), std::string::npos);  // a dark cell
  const samples::Folder plain("csv_metrology_plain");
  CsvWriter().write(samples::report(), plain.path());
  PngWriter().write(samples::report(), plain.path());
  for (const char* name : {"color_u.csv", "hot_spots.csv", "angular_spots.csv", "delta_uv.png"}) {
    EXPECT_FALSE(std::filesystem::exists(plain.path() / name)) << name;
  }
}

}  // namespace
}  // namespace evenglow::design

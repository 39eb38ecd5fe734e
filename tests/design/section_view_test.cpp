#include "design/report/section_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

std::vector<SectionLayer> stack() {
  return {{"reflectors.bottom", LayerKind::reflector, -0.05, -0.05},
          {"light_guide_plate", LayerKind::body, 0.0, 0.6},
          {"films[0]:diffuser", LayerKind::film, 0.65, 0.65},
          {"films[1]:sheet", LayerKind::body, 0.7, 0.71}};
}

TEST(SectionHeights, RiseWithTheHeightAndGiveThinPartsRoom) {
  const SectionHeights height(stack(), 50.0);
  double last = height(-2.0);
  EXPECT_DOUBLE_EQ(last, height.picture_height());
  for (double z = -1.9; z < 3.0; z += 0.01) {
    EXPECT_LE(height(z), last) << z;
    last = height(z);
  }
  EXPECT_DOUBLE_EQ(height(10.0), 0.0);
  EXPECT_GT(height(0.0) - height(0.6), 100.0) << "the plate";
  EXPECT_GT(height(0.7) - height(0.71), 30.0) << "a sheet of a hundredth of a millimeter can be seen";
  EXPECT_GT(height(0.6) - height(0.65), 20.0) << "so can a gap";
  EXPECT_NEAR(height(0.3), 0.5 * (height(0.0) + height(0.6)), 1e-9) << "linear within a body";
}

TEST(SectionView, DrawsEachStretchInTheColorOfItsPolarization) {
  SectionView view{"", 0.0, 10.0, stack(), {}};
  view.paths.push_back(
      {{{0.0, 0.3}, {5.0, 0.3}, {5.0, 2.0}}, {PolarizationLook::along_y, PolarizationLook::circular}, "leaves by top"});
  const std::string svg = section_svg(view);
  EXPECT_THAT(svg, HasSubstr("i-s2"));
  EXPECT_THAT(svg, HasSubstr("films[0]:diffuser"));
  EXPECT_THAT(svg, HasSubstr("mm</text>"));
  const std::string file = section_svg_file(view);
  EXPECT_TRUE(file.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" "));
  EXPECT_THAT(file, HasSubstr("<style>"));
}

TEST(SectionView, CutsWaysAtTheBorderOfTheStretch) {
  SectionView view{"", 0.0, 10.0, stack(), {}};
  view.paths.push_back({{{-5.0, 0.3}, {500.0, 0.3}}, {PolarizationLook::circular}, "goes on"});
  EXPECT_THAT(section_svg(view), HasSubstr("points=\"0.0,"));
  view.paths = {{{{20.0, 0.3}, {30.0, 0.3}}, {PolarizationLook::circular}, "goes on"}};
  EXPECT_THAT(section_svg(view), ::testing::Not(HasSubstr("i-s3\" stroke-width=\"1.1\"")));
}

TEST(SectionView, NamesAreEscaped) {
  SectionView view{"", 0.0, 1.0, {{"<script>", LayerKind::film, 0.0, 0.0}}, {}};
  EXPECT_THAT(section_svg(view), ::testing::Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace evenglow::design

#include "tracer/scene/cell_keys.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

std::string with_cells(const std::string& cells) {
  return "size: {}, sources: [{kind: beam}], receivers: [{kind: luminance" + cells + "}]";
}

TEST(CellKeys, TwoWholeNumbersOfAMillionCellsAtMost) {
  const core::CellGrid own = backlight_of(with_cells(", cells: [7, 3]")).luminance.cells;
  EXPECT_EQ(own.nx, 7);
  EXPECT_EQ(own.ny, 3);
  const core::CellGrid usual = backlight_of(with_cells("")).luminance.cells;
  EXPECT_EQ(usual.nx, 96);
  EXPECT_EQ(usual.ny, 48);
  for (const char* wrong : {"[7]", "[7, 3, 1]", "[7.5, 3]", "[0, 3]", "[4096, 4096]", "7"}) {
    EXPECT_THROW(backlight_of(with_cells(std::string(", cells: ") + wrong)), core::ConfigError) << wrong;
  }
}

}  // namespace
}  // namespace evenglow::tests

#include "tracer/sources/window_overlap.h"

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

/// Windows at a side, and nothing else.
class Windows final : public Source {
 public:
  Windows(Side side, std::vector<SourceWindow> windows) : side_(side), windows_(std::move(windows)) {}
  double flux() const override { return 1.0; }
  Photon emit(core::PhotonRng&) const override { return {}; }
  Side side() const override { return side_; }
  double gap() const override { return 0.0; }
  std::vector<SourceWindow> windows() const override { return windows_; }

 private:
  Side side_;
  std::vector<SourceWindow> windows_;
};

TEST(WindowOverlap, TellsTheMiddleOfWhatIsCommon) {
  const Windows a(Side::kLeft, {{0, 2, 0, 1}, {5, 7, 0, 1}});
  const Windows b(Side::kLeft, {{3, 4, 0, 1}, {6, 9, 0.5, 2}});
  ASSERT_TRUE(overlap(a, b));
  EXPECT_DOUBLE_EQ(*overlap(a, b), 6.5);
  EXPECT_DOUBLE_EQ(*overlap(b, a), 6.5);
}

TEST(WindowOverlap, TouchingAndApartDoNotCount) {
  const Windows a(Side::kLeft, {{0, 2, 0, 1}});
  EXPECT_FALSE(overlap(a, Windows(Side::kLeft, {{2, 4, 0, 1}})));
  EXPECT_FALSE(overlap(a, Windows(Side::kLeft, {{0, 2, 1, 2}})));  // above it
  EXPECT_FALSE(overlap(a, Windows(Side::kRight, {{0, 2, 0, 1}})));
  EXPECT_FALSE(overlap(a, Windows(Side::kLeft, {})));
}

}  // namespace
}  // namespace evenglow::tracer

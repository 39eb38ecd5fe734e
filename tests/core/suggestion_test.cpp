#include "core/config/suggestion.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(EditDistance, CountsChangesAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("length", "length"), 0u);
  EXPECT_EQ(edit_distance("lenght", "length"), 1u) << "a swap of neighbors";
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("abc", "b"), 2u);
}

TEST(Nearest, IsMeantOnlyIfNear) {
  const std::vector<std::string> words = {"ratio", "anderson", "gradient"};
  EXPECT_EQ(nearest("andersen", words), "anderson");
  EXPECT_EQ(nearest("raito", words), "ratio");
  EXPECT_FALSE(nearest("spline", words));
  EXPECT_FALSE(nearest("r", words));
  EXPECT_FALSE(nearest(std::string(61, 'a'), {std::string(61, 'a')}));
}

TEST(AdviceOnAKey, NamesTheUnit) {
  const std::vector<std::string> known = {"thickness_mm", "absorption_per_m", "kind"};
  EXPECT_EQ(advise_on_key("thickness", known).message, "unknown key, the unit must be mm: `thickness_mm`");
  EXPECT_EQ(advise_on_key("thickness_cm", known).meant, "thickness_mm");
  EXPECT_EQ(advise_on_key("absorption_per_mm", known).meant, "absorption_per_m");
}

TEST(AdviceOnAKey, NamesTheNearestOrAll) {
  const std::vector<std::string> known = {"thickness_mm", "kind"};
  EXPECT_EQ(advise_on_key("knid", known).message, "unknown key, did you mean `kind`?");
  EXPECT_EQ(advise_on_key("kind:dbef", known).message, "unknown key, a space must follow the colon");
  const KeyAdvice far = advise_on_key("wavelength", known);
  EXPECT_EQ(far.message, "unknown key, known here: thickness_mm, kind");
  EXPECT_FALSE(far.meant);
  EXPECT_EQ(advise_on_key("any", {}).message, "unknown key");
}

}  // namespace
}  // namespace evenglow::core

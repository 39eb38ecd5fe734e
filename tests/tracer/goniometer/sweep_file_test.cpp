#include "tracer/goniometer/sweep_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

class SweepFile : public testing::Test {
 protected:
  Film read(const std::string& text, std::optional<int> index = {},
            const std::vector<core::ConfigDocument::Override>& changes = {}) const {
    tests::write_text(folder_ / "f.yaml", text);
    return read_swept_film(folder_ / "f.yaml", index, changes);
  }
  std::string faults(const std::string& text, std::optional<int> index = {}) const {
    try {
      read(text, index);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  tests::TempFolder folder_;
};

TEST_F(SweepFile, OneFilm) {
  EXPECT_EQ(read("film: {kind: retarder, axis_deg: 90}\n").kind, "retarder");
  EXPECT_EQ(read("evenglow: 1\ntitle: my film\nfilm: {kind: lpp}\n").kind, "lpp");
  EXPECT_NEAR(read("film: {kind: lpp}\n", {}, {{"film.gap_mm", "0.3", "--set"}}).gap, 0.3, 1e-15);
}

/// The rest of a run file may be anything: another command judges it.
TEST_F(SweepFile, FilmOfARunFile) {
  const std::string run =
      "evenglow: 1\nbacklight:\n  sources: nonsense\n  films: [{kind: diffuser}, {kind: carrier, axis_deg: 3}]\n"
      "variants: {a: {}}\n";
  EXPECT_EQ(read(run, 0).kind, "diffuser");
  EXPECT_EQ(read(run, 1).kind, "carrier");
  EXPECT_EQ(read("backlight: {films: [{kind: sheet}]}\n").kind, "sheet");
}

TEST_F(SweepFile, NamesFaults) {
  const std::string two = "backlight: {films: [{kind: lpp}, {kind: lpp, k1: 3}]}\n";
  EXPECT_THAT(faults(two), HasSubstr("--film: must say which of the films 0 to 1"));
  EXPECT_THAT(faults(two, 2), HasSubstr("--film: must be at most 1"));
  EXPECT_EQ(faults(two, 0), "accepted");
  EXPECT_THAT(faults(two, 1), HasSubstr("films[1].k1: must lie in [0, 1]"));
  EXPECT_THAT(faults("film: {kind: lpp}\n", 0), HasSubstr("--film: must not be given"));
  EXPECT_THAT(faults("film: {kind: foil}\n"), HasSubstr("film.kind"));
  EXPECT_THAT(faults("film: {kind: lpp}\nother: 3\n"), HasSubstr("other: unknown key"));
  EXPECT_THAT(faults("title: nothing\n"), HasSubstr("must hold a map film or a list backlight.films"));
  EXPECT_THAT(faults("backlight: {films: 3}\n"), HasSubstr("backlight.films: must be a list"));
  EXPECT_THAT(faults("backlight: {films: [3]}\n"), HasSubstr("films[0]"));
}

}  // namespace
}  // namespace evenglow::tracer

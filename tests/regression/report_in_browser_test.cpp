#include <fstream>

#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// The report of a comparison as a reader uses it, in headless Chromium (Debian package `chromium`; without it the
/// tests are skipped). report_in_browser.py holds what is shown against the result files.
namespace evenglow::tests {
namespace {

class ReportInBrowserLong : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"/bin/sh", "-c", "command -v chromium"}).code, 0)
        << "chromium must be installed (scripts/packages_development.txt)";
    write_text(folder_ / "tiny.yaml", kTinyRun);
  }

  /// Compares, then opens the page; 0 if it is as it should be.
  ProgramResult drive(const std::vector<std::string>& changes) {
    std::vector<std::string> words{"compare", "tiny.yaml", "-o", "out", "--quiet"};
    words.insert(words.end(), changes.begin(), changes.end());
    const ProgramResult made = evenglow(words, folder_.path());
    EXPECT_EQ(made.code, 0) << made.err;
    return run_again();
  }
  ProgramResult run_again() const {
    return run_program(
        {"/usr/bin/python3", EVENGLOW_SOURCE_DIR "/tests/regression/report_in_browser.py", (folder_ / "out").string()},
        {}, 300.0);
  }

  TempFolder folder_;
};

TEST_F(ReportInBrowserLong, ShowsWhatTheResultsSay) {
  const ProgramResult seen = drive({});
  EXPECT_EQ(seen.code, 0) << seen.err;
}

TEST_F(ReportInBrowserLong, IsFastWith128By72Cells) {
  const ProgramResult seen = drive({"--set", "backlight.microstructure.cells=[128, 72]", "--set",
                                    "backlight.receivers=[{kind: luminance, cells: [128, 72]}]", "--set",
                                    "design.max_steps=1", "--photons", "400000"});
  EXPECT_EQ(seen.code, 0) << seen.err;
}

TEST_F(ReportInBrowserLong, TakesAHostileTitleAsText) {
  const ProgramResult seen =
      drive({"--set", "title=\"</script><script>alert(1)</script><img src=x onerror=alert(2)>\""});
  EXPECT_EQ(seen.code, 0) << seen.err;
}

/// The driver itself must see faults: a page whose numbers are not those of the results, and one that loads something.
TEST_F(ReportInBrowserLong, SeesAPageThatIsWrong) {
  ASSERT_EQ(drive({}).code, 0);
  const std::filesystem::path page = folder_ / "out" / "report.html";
  const std::string good = file_text(page);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    bad.replace(at, from.size(), to);
    std::ofstream(page, std::ios::binary) << bad;
    return run_again();
  };
  const ProgramResult mirrored = changed("(ix + 0.5) * map.dx", "(ix + 1.5) * map.dx");
  EXPECT_EQ(mirrored.code, 1) << mirrored.out;
  EXPECT_NE(mirrored.err.find(" x: shown"), std::string::npos) << mirrored.err;
  const ProgramResult noisy = changed("<main>", "<img src=\"https://example.invalid/a.png\"><main>");
  EXPECT_EQ(noisy.code, 1) << noisy.out;
  const ProgramResult scripted = changed("<main>", "<script>alert(1)</script><main>");
  EXPECT_EQ(scripted.code, 1) << scripted.out;
  EXPECT_NE(scripted.err.find("dialog"), std::string::npos) << scripted.err;
  const ProgramResult broken = changed("'use strict';", "'use strict'; setTimeout(function () { missing(); }, 0);");
  EXPECT_EQ(broken.code, 1) << broken.out;
  EXPECT_NE(broken.err.find("exception"), std::string::npos) << broken.err;
}

}  // namespace
}  // namespace evenglow::tests

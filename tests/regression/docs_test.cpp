#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// The pages of docs/: what they tell a reader to type works, in a short form (few photons, few steps), and their links
/// lead somewhere. scripts/check_docs does the work.
namespace evenglow::tests {
namespace {

ProgramResult check_docs(const std::vector<std::string>& words, const std::filesystem::path& folder = {}) {
  std::vector<std::string> all{EVENGLOW_SOURCE_DIR "/scripts/check_docs", "--program", EVENGLOW_PROGRAM, "--photons",
                               "10000"};
  all.insert(all.end(), words.begin(), words.end());
  return run_program(all, folder, 1800.0);
}

TEST(Docs, LinksLeadSomewhere) {
  const ProgramResult seen = check_docs({"--links"});
  EXPECT_EQ(seen.code, 0) << seen.err;
}

TEST(Docs, TutorialWorks) {
  const ProgramResult seen = check_docs({EVENGLOW_SOURCE_DIR "/docs/tutorial.md"});
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
}

TEST(Docs, PagesOnLedsProfilesAndEstimatorsWork) {
  const ProgramResult seen =
      check_docs({EVENGLOW_SOURCE_DIR "/docs/howto_own_led.md", EVENGLOW_SOURCE_DIR "/docs/howto_target_profile.md",
                  EVENGLOW_SOURCE_DIR "/docs/explain_estimator.md"});
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
}

TEST(DocsLong, AllPagesWork) {
  const ProgramResult seen = check_docs({});
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
}

/// The comments of all headers fit their declarations.
TEST(Docs, ReferenceOfTheInterfaceIsMade) {
  const TempFolder folder;
  const ProgramResult seen =
      run_program({EVENGLOW_SOURCE_DIR "/scripts/make_api_reference", (folder.path() / "api").string()}, {}, 300.0);
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "api/html/index.html"));
}

/// The check itself must see faults.
class DocsCheck : public ::testing::Test {
 protected:
  ProgramResult of(const std::string& text, const std::vector<std::string>& words = {}) {
    write_text(folder_ / "page.md", text);
    std::vector<std::string> all{(folder_ / "page.md").string()};
    all.insert(all.end(), words.begin(), words.end());
    return check_docs(all);
  }

  TempFolder folder_;
};

TEST_F(DocsCheck, PassesAGoodPage) {
  const ProgramResult seen = of("```sh\nevenglow --version > a.txt\n```\n<!-- makes: a.txt -->\n");
  EXPECT_EQ(seen.code, 0) << seen.out << seen.err;
}

TEST_F(DocsCheck, SeesACommandThatFails) {
  const ProgramResult seen = of("text\n\n```sh\nevenglow check nothing.yaml\n```\n");
  EXPECT_EQ(seen.code, 1);
  EXPECT_NE(seen.err.find("page.md:4: exit code"), std::string::npos) << seen.err;
}

TEST_F(DocsCheck, SeesACommandThatShouldFailAndDoesNot) {
  EXPECT_EQ(of("```sh\ntrue\n```\n<!-- exit: 2 -->\n").code, 1);
}

TEST_F(DocsCheck, SeesAFileThatIsNotMade) {
  const ProgramResult seen = of("```sh\ntouch empty.txt\n```\n<!-- makes: empty.txt none.txt -->\n");
  EXPECT_EQ(seen.code, 1);
  EXPECT_NE(seen.err.find("did not make empty.txt, none.txt"), std::string::npos) << seen.err;
}

TEST_F(DocsCheck, SeesAPageWithoutBlocks) {
  EXPECT_EQ(of("nothing to run\n").code, 1);
}

TEST_F(DocsCheck, SeesATextThatIsNotPrinted) {
  const std::string block = "```sh\nprintf 'first\\nat 2.5 +- 0.1 cm, 3 s\\n'\n```\n\n";
  const std::string text = "```text\nat 7 +- 1e-3 cm, 0.1 s\n```\n";
  EXPECT_EQ(of(block + text).code, 0) << "other numbers are none of its business";
  const ProgramResult full = of(block + text, {"--full"});
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("page.md:6: the program does not print `at 7 +- 1e-3 cm, 0.1 s`"), std::string::npos)
      << full.err;
  EXPECT_EQ(of(block + "```text\nat 2.5 +- 0.1 cm, 9 s\n```\n", {"--full"}).code, 0) << "times are not compared";
  EXPECT_EQ(of(block + "```text\nat 7 cm, 0.1 s\n```\n").code, 1);
}

TEST_F(DocsCheck, SeesATextThatNothingPrints) {
  EXPECT_EQ(of("```text\nnothing\n```\n\n```sh\ntrue\n```\n").code, 1);
}

TEST_F(DocsCheck, SeesLinksThatLeadNowhere) {
  const ProgramResult seen = of("# A heading\n\n[a](#a-heading) [b](#other) [c](none.md)\n", {"--links"});
  EXPECT_EQ(seen.code, 1);
  EXPECT_EQ(seen.err.find("#a-heading"), std::string::npos) << seen.err;
  EXPECT_NE(seen.err.find("#other: no such heading"), std::string::npos) << seen.err;
  EXPECT_NE(seen.err.find("none.md: no such file"), std::string::npos) << seen.err;
}

}  // namespace
}  // namespace evenglow::tests

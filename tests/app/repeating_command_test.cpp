#include "app/repeating_command.h"

#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace evenglow::app {
namespace {

TEST(Quoted, LeavesPlainWordsAlone) {
  for (const char* word : {"tiny.yaml", "a/b-c_d.e", "trace.photons=20e6", "-1", "a:b,c@d%e^f+g"}) {
    EXPECT_EQ(quoted(word), word);
  }
}

TEST(Quoted, QuotesTheRest) {
  EXPECT_EQ(quoted(""), "''");
  EXPECT_EQ(quoted("a b"), "'a b'");
  EXPECT_EQ(quoted("it's"), "'it'\\''s'");
  EXPECT_EQ(quoted("films[1]=lpp"), "'films[1]=lpp'");
}

TEST(Quoted, IsReadBackByTheShell) {
  const std::string words[] = {"",      "a b", "it's",     "$HOME `id` $(id)", "a\nb\tc",
                               "\\",    "!!",  "{a,b}",    "~/x *.cpp?",       "a#b;c",
                               "\"x\"", "'",   "\xc3\xa4", "a=b&c|d<e>f"};
  for (const std::string& word : words) {
    const auto result = tests::run_program({"/bin/sh", "-c", "printf %s " + quoted(word)});
    EXPECT_EQ(result.out, word);
  }
}

TEST(RepeatingCommand, HoldsWhatChangesTheNumbersAndNothingElse) {
  Options options;
  options.files = {"my run.yaml"};
  options.out = "elsewhere";
  options.threads = 3;
  options.quiet = options.overwrite = options.resume = true;
  EXPECT_EQ(repeating_command("design", options), "evenglow design 'my run.yaml'");
  options.set = {"title=a b", "trace.batches=10"};
  options.seed.emplace("5");
  options.photons.emplace("1e6");
  EXPECT_EQ(repeating_command("design", options),
            "evenglow design 'my run.yaml' --set 'title=a b' --set trace.batches=10 --seed 5 --photons 1e6");
}

}  // namespace
}  // namespace evenglow::app

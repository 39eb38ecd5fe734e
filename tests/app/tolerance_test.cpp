#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow tolerance` as a whole.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Tolerance : public ::testing::Test {
 protected:
  Tolerance() {
    write_text(folder_ / "tiny.yaml", file_of("[{kind: dot_growth_um, normal: 3}, {kind: led_flux, normal: 0.1}]"));
  }

  /// The tiny run with a map `tolerance`.
  static std::string file_of(const std::string& variations, const std::string& more = "samples: 12, photons: 2000") {
    return std::string(kTinyRun) + "tolerance: {" + more + ", variations: " + variations + "}\n";
  }
  ProgramResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), "tolerance");
    words.insert(words.begin() + 1, "tiny.yaml");
    words.push_back("--quiet");
    return evenglow(words, folder_.path());
  }
  std::string text(const std::string& file) const { return file_text(folder_ / file); }
  /// A column of tolerance.csv by its name.
  std::vector<double> column(const std::string& directory, const std::string& name) const {
    std::istringstream lines(text(directory + "/tolerance.csv"));
    std::vector<double> values;
    std::string line;
    std::getline(lines, line);
    std::size_t index = 0, quoted = 0;
    std::string head;
    std::size_t found = std::string::npos;
    for (const char c : line + ',') {
      if (c == '"') quoted ^= 1U;
      if (c == ',' && quoted == 0) {
        if (head == name) found = index;
        ++index;
        head.clear();
      } else if (c != '"') {
        head += c;
      }
    }
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string cell;
      for (std::size_t i = 0; i <= found; ++i) std::getline(cells, cell, ',');
      values.push_back(std::stod(cell));
    }
    return values;
  }
  TempFolder folder_;
};

TEST_F(Tolerance, WritesItsFilesAndTellsTheYield) {
  const ProgramResult result =
      run({"-o", "out", "--set", "tolerance.limits={luminance_mean_cd_m2: {min: 1}, efficiency: {max: 0.01}}"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("all limits"));
  for (const char* name : {"tolerance.csv", "tolerance.json", "tolerance.html", "tolerance.png", "luminance_mean.csv",
                           "luminance_spread.csv"})
    EXPECT_FALSE(text(std::string("out/") + name).empty()) << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "checkpoint.json"));
  const auto json = json_of(folder_ / "out" / "tolerance.json");
  EXPECT_EQ(json["samples"], 12);
  EXPECT_EQ(json["limits"]["luminance_mean_cd_m2"]["yield"]["seen"]["value"], 1.0);
  EXPECT_EQ(json["limits"]["efficiency"]["yield"]["seen"]["value"], 0.0);
  EXPECT_EQ(json["yield"]["passed"], 0);
  EXPECT_EQ(json["worst"].size(), 12U);
  EXPECT_THAT(text("out/tolerance.html"), Not(HasSubstr("src=\"http")));
  EXPECT_EQ(run({"-o", "out"}).code, 2) << "another result is not replaced unasked";
}

/// One LED whose flux varies, every sample with the same random numbers: its luminance is its flux times a constant, to
/// the last photon.
TEST_F(Tolerance, LuminanceFollowsTheFluxOfTheLeds) {
  write_text(folder_ / "tiny.yaml",
             file_of("[{kind: led_flux, normal: 0.1}]", "samples: 20, photons: 2000, common_numbers: true"));
  ASSERT_EQ(run({"-o", "out", "--set", "backlight.sources[0].count=1"}).code, 0);
  const auto flux = column("out", "led_flux, mean"), luminance = column("out", "luminance_mean_cd_m2");
  ASSERT_EQ(flux.size(), 20U);
  for (std::size_t i = 1; i < flux.size(); ++i) {
    EXPECT_NE(flux[i], flux[0]);
    EXPECT_NEAR(luminance[i] / flux[i], luminance[0] / flux[0], 1e-9 * luminance[0]);
  }
  EXPECT_NEAR(column("out", "rms_corrected")[3], column("out", "rms_corrected")[0], 1e-9);
}

/// Two LEDs of independent flux (standard deviation 10 %), random numbers of their own: the mean luminance spreads by
/// 10 % / sqrt(2), the Monte Carlo noise (about as much) taken off. Seed fixed; the 95 % interval taken at twice its
/// width: false alarm 1e-4.
TEST_F(Tolerance, SpreadOfTheMeanLuminanceIsThatOfTheFluxes) {
  write_text(folder_ / "tiny.yaml", file_of("[{kind: led_flux, normal: 0.1}]", "samples: 200, photons: 1000"));
  ASSERT_EQ(run({"-o", "out"}).code, 0);
  const auto figure = json_of(folder_ / "out" / "tolerance.json")["figures"]["luminance_mean_cd_m2"];
  const double mean = figure["mean"].get<double>(), expected = 0.1 * 0.98658 / std::sqrt(2.0);
  const double value = figure["spread"].get<double>() / mean;
  EXPECT_NEAR(value, expected, 4.0 * figure["spread_se"].get<double>() / mean);
  EXPECT_GT(figure["noise"].get<double>() / mean, 0.02) << "or the noise was not put to the test";
  EXPECT_NEAR(mean, figure["nominal"].get<double>(),
              5.0 * std::hypot(figure["mean_se"].get<double>(), figure["nominal_se"].get<double>()));
}

TEST_F(Tolerance, IsTheSameOnAnyNumberOfThreads) {
  ASSERT_EQ(run({"-o", "one", "--threads", "1"}).code, 0);
  ASSERT_EQ(run({"-o", "four", "--threads", "4"}).code, 0);
  for (const char* name : {"tolerance.csv", "tolerance.json", "luminance_spread.csv"})
    EXPECT_EQ(text(std::string("one/") + name), text(std::string("four/") + name)) << name;
}

TEST_F(Tolerance, ASampleIsReplayedWhole) {
  ASSERT_EQ(run({"-o", "out"}).code, 0);
  const ProgramResult one = run({"-o", "third", "--sample", "3", "--photons", "2e5"});
  ASSERT_EQ(one.code, 0) << one.err;
  const auto json = json_of(folder_ / "third" / "result.json");
  EXPECT_THAT(json["title"].get<std::string>(), HasSubstr("sample 3"));
  const double luminance = json["final"]["luminance_mean_cd_m2"].get<double>();
  const double se = column("out", "luminance_mean_cd_m2_se")[2];
  EXPECT_NEAR(column("out", "luminance_mean_cd_m2")[2], luminance, 5.0 * se);
  EXPECT_THAT(text("third/report.html"), HasSubstr("flux_factors"));
  EXPECT_EQ(run({"-o", "nominal", "--sample", "0"}).code, 0);
  const ProgramResult none = run({"-o", "none", "--sample", "13"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("--sample: must lie in [0, 12]"));
  const ProgramResult both = run({"-o", "out", "--sample", "3", "--resume"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--sample: must not stand beside --resume"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/tolerance.json")) << "nothing is lost";
}

TEST_F(Tolerance, TheDensityOfADesignIsMade) {
  std::filesystem::create_directory(folder_ / "design");
  write_text(folder_ / "design" / "density.csv", "0.5,0.5\n0.5,0.5\n");
  ASSERT_EQ(run({"-o", "made", "--design", "design", "--sample", "0"}).code, 0);
  EXPECT_THAT(text("made/density.csv"), HasSubstr("0.5,0.5"));
  const ProgramResult wrong = run({"-o", "wrong", "--design", "nowhere"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("tolerance.result"));
}

/// Faults before the first photon: no directory is made.
TEST_F(Tolerance, WrongInputIsToldBeforeAPhoton) {
  const auto fault = [&](const std::string& variations) {
    write_text(folder_ / "tiny.yaml", file_of(variations));
    const ProgramResult result = run({"-o", "wrong"});
    EXPECT_EQ(result.code, 2) << variations;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong"));
    return result.err;
  };
  EXPECT_THAT(fault("[]"), HasSubstr("tolerance.variations: must be a list"));
  EXPECT_THAT(fault("[{kind: key, key: \"backlight.films[0].absorption\", normal: 0.1}]"),
              HasSubstr("variations[0].key: must be given in the run file as a number"));
  EXPECT_THAT(fault("[{kind: key, key: \"backlight.films[0].reflectance\", normal: 0.05}]"),
              HasSubstr("tolerance.variations[0]: backlight.films[0]"));
  EXPECT_THAT(fault("[{kind: led_along_mm, normal: 0.5}]"),
              HasSubstr("tolerance.variations[0]: backlight.sources[0].offsets_mm"));
  EXPECT_THAT(fault("[{kind: led_height_mm, normal: 0.1}]"), HasSubstr("height_offsets_mm"));
  // Allowed at both ends (1 and 3 LEDs), not between them.
  EXPECT_THAT(fault("[{kind: key, key: \"backlight.sources[0].count\", uniform: 1}, {kind: key, key: "
                    "\"backlight.sources[0].pitch_mm\", choices: [3]}]"),
              HasSubstr("a whole number"));
  EXPECT_THAT(fault("[{kind: dot_growth_um, normal: 1}, {kind: led_flux, normal: 0.1}, {kind: key, key: "
                    "\"backlight.microstructure.cells[0]\", choices: [4000]}]"),
              HasSubstr("the samples would not have the cells"));
}

/// What `tolerance` would refuse, `check` refuses.
TEST_F(Tolerance, CheckLooksAtTheVariations) {
  const auto check = [&](const std::string& variations) {
    write_text(folder_ / "tiny.yaml", file_of(variations));
    return evenglow({"check", "tiny.yaml"}, folder_.path());
  };
  const ProgramResult good = check("[{kind: led_flux, normal: 0.1}]");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("tiny.yaml: 1 variations are good"));
  for (const char* wrong : {"backlight.films[0].kind", "backlight.films[7].haze", "backlight.microstructure"}) {
    const ProgramResult result = check("[{kind: key, key: \"" + std::string(wrong) + "\", normal: 0.1}]");
    EXPECT_EQ(result.code, 2) << wrong;
    EXPECT_THAT(result.err, HasSubstr("tolerance.variations[0]")) << wrong;
  }
  const ProgramResult none = check("[{kind: led_flux, choices: []}]");
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("choices: must hold at least one value, got none"));
}

class ToleranceAfterSignal : public Tolerance, public ::testing::WithParamInterface<int> {};

/// What an interruption leaves goes on to the bits of the whole run.
TEST_P(ToleranceAfterSignal, EndsInTheSameBits) {
  const auto words = [](const std::string& out) {
    return std::vector<std::string>{"tolerance", "tiny.yaml", "-o",    out,
                                    "--threads", "2",         "--set", "tolerance.photons=2e4"};
  };
  ASSERT_EQ(evenglow(words("whole"), folder_.path()).code, 0);
  Program program(words_of(EVENGLOW_PROGRAM, words("cut")), folder_.path());
  const auto state = folder_ / "cut" / "checkpoint.json";
  while (program.is_running() && !std::filesystem::exists(state))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // some samples
  program.send(GetParam());
  const ProgramResult stopped = program.wait(60);
  EXPECT_EQ(stopped.code, GetParam() == SIGKILL ? 128 + SIGKILL : 130) << stopped.err;
  ASSERT_TRUE(std::filesystem::exists(state));
  EXPECT_EQ(evenglow(words("cut"), folder_.path()).code, 2) << "another run's state is not replaced unasked";

  auto other = words("cut");
  other.insert(other.end(), {"--resume", "--set", "tolerance.seed=2"});
  const ProgramResult refused = evenglow(other, folder_.path());
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("it is of another run"));

  auto again = words("cut");
  again.push_back("--resume");
  const ProgramResult resumed = evenglow(again, folder_.path());
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("resumed after sample "));
  for (const char* name : {"tolerance.csv", "luminance_mean.csv", "luminance_spread.csv"})
    EXPECT_EQ(text(std::string("cut/") + name), text(std::string("whole/") + name)) << name;
  EXPECT_FALSE(std::filesystem::exists(state));
  EXPECT_EQ(evenglow(again, folder_.path()).code, 2) << "a finished run has nothing to resume";
}

INSTANTIATE_TEST_SUITE_P(Signals, ToleranceAfterSignal, ::testing::Values(SIGINT, SIGKILL),
                         [](const ::testing::TestParamInfo<int>& signal) {
                           return signal.param == SIGINT ? "Int" : "Kill";
                         });

}  // namespace
}  // namespace evenglow::tests

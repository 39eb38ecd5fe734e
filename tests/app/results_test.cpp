#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/sha256.h"
#include "tests/app/tiny_run.h"

/// What `simulate`, `design` and `compare` leave behind, as users rely on it.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;

using Json = nlohmann::ordered_json;

const std::vector<std::string> kRunFiles = {"result.json", "convergence.csv", "luminance.csv",   "luminance_se.csv",
                                            "density.csv", "angular.csv",     "convergence.png", "luminance.png",
                                            "density.png", "report.html",     "hot_spots.csv"};

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

void expect_numbers(const Json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    ASSERT_TRUE(object.contains(key)) << key;
    EXPECT_TRUE(object.at(key).is_number()) << key << ": " << object.at(key);
  }
}

double share_sum(const Json& energy) {
  double sum = energy.at("lost").get<double>();
  for (const char* group : {"escaped", "absorbed"}) {
    for (const auto& [name, share] : energy.at(group).items()) sum += share.get<double>();
  }
  return sum;
}

/// The keys of INTERFACE, and that the energy is all there.
void expect_complete(const Json& result, std::size_t steps) {
  EXPECT_EQ(result.at("format"), "evenglow-result/1");
  for (const char* key : {"version", "title", "run_file_sha256", "stop_reason", "command"}) {
    EXPECT_TRUE(result.at(key).is_string()) << key;
  }
  expect_numbers(result, {"seed", "threads", "ranks"});
  ASSERT_EQ(result.at("steps").size(), steps);
  for (const Json& step : result.at("steps")) {
    expect_numbers(step, {"step", "photons", "rms", "rms_corrected", "rms_corrected_se", "efficiency", "efficiency_se",
                          "mean_density", "luminance_mean_cd_m2"});
  }
  expect_numbers(result.at("final"), {"photons", "rms", "rms_corrected", "rms_corrected_se", "uniformity_9",
                                      "uniformity_13", "luminance_mean_cd_m2", "luminance_mean_se",
                                      "luminance_centre_cd_m2", "efficiency", "efficiency_se"});
  expect_numbers(result.at("timing"), {"wall_s", "cpu_s", "photons_per_cpu_s"});
  const Json& energy = result.at("energy");
  EXPECT_DOUBLE_EQ(energy.at("emitted_lm").get<double>(), 18.0);
  for (const char* side : {"left", "right", "front", "back", "bottom", "top"}) {
    EXPECT_TRUE(energy.at("escaped").contains(side)) << side;
  }
  EXPECT_NEAR(share_sum(energy), 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(energy.at("escaped").at("top").get<double>(), result.at("final").at("efficiency").get<double>());
}

class Results : public ::testing::Test {
 protected:
  Results() { write_text(folder_ / "tiny.yaml", kTinyRun); }

  void run(std::vector<std::string> words) {
    words.push_back("--quiet");
    const ProgramResult result = evenglow(words, folder_.path());
    ASSERT_EQ(result.code, 0) << result.err;
    out_ = result.out;
  }

  TempFolder folder_;
  std::string out_;
};

TEST_F(Results, OfSimulateAreComplete) {
  run({"simulate", "tiny.yaml", "-o", "out"});
  EXPECT_THAT(names_in(folder_ / "out"), UnorderedElementsAreArray(kRunFiles));
  const Json result = json_of(folder_ / "out" / "result.json");
  expect_complete(result, 1);
  EXPECT_EQ(result.at("run_file_sha256"), core::sha256_hex(kTinyRun));
  EXPECT_EQ(result.at("seed"), 7);
  EXPECT_EQ(result.at("final").at("photons"), 20000);
}

TEST_F(Results, OfDesignAreComplete) {
  run({"design", "tiny.yaml", "-o", "out"});
  EXPECT_THAT(names_in(folder_ / "out"), UnorderedElementsAreArray(kRunFiles));
  expect_complete(json_of(folder_ / "out" / "result.json"), 4);
  EXPECT_THAT(out_, HasSubstr("mean luminance"));
}

TEST_F(Results, OfCompareAreComplete) {
  run({"compare", "tiny.yaml", "-o", "out"});
  EXPECT_THAT(names_in(folder_ / "out"),
              UnorderedElementsAreArray({"compare.json", "compare.csv", "compare.png", "report.html", "lpp", "dbef"}));
  const Json comparison = json_of(folder_ / "out" / "compare.json");
  for (const std::string name : {"lpp", "dbef"}) {
    EXPECT_THAT(names_in(folder_ / "out" / name), UnorderedElementsAreArray(kRunFiles));
    const Json result = json_of(folder_ / "out" / name / "result.json");
    expect_complete(result, 4);
    EXPECT_EQ(result.at("variant"), name);
    EXPECT_EQ(comparison.at("variants").at(name).at("luminance_mean_cd_m2"),
              result.at("final").at("luminance_mean_cd_m2"));
  }
  ASSERT_EQ(comparison.at("ratio").size(), 1u);
  const Json& ratio = comparison.at("ratio").at("dbef/lpp");
  expect_numbers(ratio, {"luminance", "luminance_se", "flux", "flux_se", "efficiency", "efficiency_se"});
  EXPECT_GT(ratio.at("luminance").get<double>(), 1.2) << "an ideal DBEF recycles what an LPP absorbs";
  EXPECT_THAT(out_, HasSubstr("dbef/lpp"));
}

TEST_F(Results, OfSeveralFilesStandSideBySide) {
  std::filesystem::create_directory(folder_ / "other");
  write_text(folder_ / "other" / "tiny.yaml", kTinyRun);
  write_text(folder_ / "third.yaml", kTinyRun);
  run({"compare", "tiny.yaml", "other/tiny.yaml", "third.yaml", "-o", "out", "--set", "output=[json]", "--photons",
       "2000", "--set", "design.max_steps=1"});
  const Json comparison = json_of(folder_ / "out" / "compare.json");
  std::vector<std::string> names;
  for (const auto& [name, value] : comparison.at("variants").items()) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAre("tiny", "tiny-2", "third"));
  for (const std::string& name : names)
    EXPECT_THAT(names_in(folder_ / "out" / name), ::testing::ElementsAre("result.json"));
  EXPECT_EQ(comparison.at("ratio").size(), 2u);
}

TEST_F(Results, HoldTheFormatsAskedFor) {
  run({"simulate", "tiny.yaml", "-o", "out", "--set", "output=[csv]"});
  EXPECT_THAT(names_in(folder_ / "out"),
              UnorderedElementsAreArray({"convergence.csv", "luminance.csv", "luminance_se.csv", "density.csv",
                                         "angular.csv", "hot_spots.csv"}));
}

const std::vector<std::string> kColorFiles = {"color_u.csv",  "color_u_se.csv",  "color_v.csv", "color_v_se.csv",
                                              "delta_uv.csv", "delta_uv_se.csv", "delta_uv.png"};

TEST_F(Results, HoldTheColorAskedFor) {
  run({"design", "tiny.yaml", "-o", "out", "--set", "backlight.sources[0].spectrum={kind: white_led}", "--set",
       "backlight.receivers=[{kind: color}, {kind: angular, at: center}]", "--set", "design.max_steps=1"});
  std::vector<std::string> files = kRunFiles;
  files.insert(files.end(), kColorFiles.begin(), kColorFiles.end());
  files.push_back("angular_spots.csv");
  EXPECT_THAT(names_in(folder_ / "out"), UnorderedElementsAreArray(files));
  const Json result = json_of(folder_ / "out" / "result.json");
  const Json& color = result.at("color");
  expect_numbers(
      color, {"shift_uv", "shift_uv_se", "delta_uv_rms", "delta_uv_rms_corrected", "delta_uv_rms_corrected_se",
              "delta_uv_max", "delta_uv_max_se", "delta_uv_max_corrected", "delta_uv_max_corrected_se", "dark_cells"});
  expect_numbers(color.at("mean"), {"x", "x_se", "y", "y_se", "u", "u_se", "v", "v_se", "cct_k", "cct_k_se", "duv"});
  expect_numbers(color.at("emitted"), {"x", "y", "u", "v", "cct_k", "duv"});
  EXPECT_EQ(result.at("half_maximum").at("spots").size(), 1u);
  ASSERT_EQ(result.at("hot_spot").size(), 1u);
  EXPECT_EQ(result.at("hot_spot")[0].at("edge"), "left");
  EXPECT_THAT(out_, HasSubstr("color RMS"));
  EXPECT_THAT(file_text(folder_ / "out" / "report.html"), HasSubstr("<h2>Color</h2>"));
}

TEST_F(Results, KnowNoColorThatWasNotAskedFor) {
  run({"simulate", "tiny.yaml", "-o", "out"});
  EXPECT_FALSE(json_of(folder_ / "out" / "result.json").contains("color"));
  EXPECT_EQ(file_text(folder_ / "out" / "report.html").find("<h2>Color</h2>"), std::string::npos);
}

TEST_F(Results, TellWhatTheOptionsChangedAndHowToRepeatThem) {
  run({"design", "tiny.yaml", "-o", "out one", "--seed", "11", "--photons", "3e3", "--threads", "2", "--set",
       "title=a 'b'", "--set", "output=[json]"});
  const Json result = json_of(folder_ / "out one" / "result.json");
  EXPECT_EQ(result.at("seed"), 11);
  EXPECT_EQ(result.at("threads"), 2);
  EXPECT_EQ(result.at("title"), "a 'b'");
  EXPECT_EQ(result.at("final").at("photons"), 3000);
  EXPECT_EQ(result.at("overrides"), (Json{"title=a 'b'", "output=[json]", "trace.seed=11", "trace.photons=3e3"}));
  EXPECT_EQ(result.at("command"),
            "evenglow design tiny.yaml --set 'title=a '\\''b'\\''' --set 'output=[json]' --seed 11 --photons 3e3");
}

TEST_F(Results, AreRepeatedByTheCommandThatTheyTell) {
  run({"design", "tiny.yaml", "-o", "first", "--set", "title=a 'b' $HOME", "--seed", "3", "--threads", "1"});
  const std::string command = json_of(folder_ / "first" / "result.json").at("command");
  ASSERT_THAT(command, ::testing::StartsWith("evenglow "));
  const ProgramResult again =
      run_program({"/bin/sh", "-c", EVENGLOW_PROGRAM + command.substr(8) + " -o second --quiet"}, folder_.path());
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(lasting_part(folder_ / "first" / "result.json"), lasting_part(folder_ / "second" / "result.json"));
}

TEST_F(Results, OverridesOfAVariantAreTold) {
  run({"compare", "tiny.yaml", "-o", "out", "--photons", "2000", "--set", "design.max_steps=0"});
  const Json overrides = json_of(folder_ / "out" / "lpp" / "result.json").at("overrides");
  EXPECT_EQ(overrides, (Json{"backlight.films[1]={kind: lpp}", "design.max_steps=0", "trace.photons=2000"}));
}

TEST_F(Results, OfADesignInTheDarkAreRefused) {
  const ProgramResult dark =
      evenglow({"design", "tiny.yaml", "-o", "out", "--quiet", "--set", "backlight.films[1]={kind: lpp, k1: 0, k2: 0}"},
               folder_.path());
  EXPECT_EQ(dark.code, 1);
  EXPECT_THAT(dark.err, HasSubstr("no light reached the display's active area in step 0"));
}

}  // namespace
}  // namespace evenglow::tests

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow film goniometer` and `evenglow film fit` as a user runs them.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kConfigs = std::string(EVENGLOW_SOURCE_DIR) + "/configs";

class FilmGoniometer : public ::testing::Test {
 protected:
  ProgramResult run(const std::vector<std::string>& words) const { return evenglow(words, folder_.path()); }

  TempFolder folder_;
};

TEST_F(FilmGoniometer, WritesTablesPicturesAndMetrics) {
  const auto result = run({"film", "goniometer", kConfigs + "/dbef_goniometer.yaml", "-o", "out", "--photons", "2e4",
                           "--quiet", "--threads", "2"});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* word : {"chi-square", "published", "22.0", "29.3", "fitted to these very measurements"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
  for (const char* name : {"reflection.csv", "transmission.csv", "bsdf.png", "reflection.png", "transmission.png"}) {
    EXPECT_TRUE(std::filesystem::file_size(folder_ / "out" / name) > 1000) << name;
  }
  const auto json = json_of(folder_ / "out/goniometer.json");
  EXPECT_EQ(json["format"], "evenglow-goniometer/1");
  EXPECT_EQ(json["metrics"]["reflection"]["table"]["rows"], 72);
  EXPECT_LT(json["metrics"]["both"]["table"]["l2"], 0.03);
  EXPECT_THAT(json["command"], HasSubstr("film goniometer"));
  // A second run must not overwrite the first one unasked.
  const auto again = run({"film", "goniometer", kConfigs + "/dbef_goniometer.yaml", "-o", "out", "--no-trace"});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("goniometer.json"));
}

TEST_F(FilmGoniometer, EvaluationAlone) {
  const auto result = run({"film", "goniometer", kConfigs + "/dbef_goniometer.yaml", "-o", "out", "--no-trace", "--set",
                           "goniometer.film={kind: dbef, model: {}}"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("traced against evaluated")));
  EXPECT_FALSE(json_of(folder_ / "out/goniometer.json").contains("agreement"));
}

TEST_F(FilmGoniometer, FaultsNameTheirLine) {
  write_text(folder_ / "run.yaml",
             "evenglow: 1\ngoniometer:\n  film: {kind: diffuser}\n  detector: {acceptance_deg: 20}\n  pis_deg: [0]\n");
  const auto result = run({"film", "goniometer", "run.yaml", "-o", "out"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("run.yaml:4:"));
  EXPECT_THAT(result.err, HasSubstr("goniometer.detector.acceptance_deg"));
  EXPECT_THAT(result.err, HasSubstr("run.yaml:5:"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(FilmGoniometer, FitWritesARunFileThatTheGoniometerTakes) {
  const auto fit =
      run({"film", "fit", "--reflection", kConfigs + "/data/dbef_reflection_luminance.csv", "--transmission",
           kConfigs + "/data/dbef_transmission_luminance.csv", "-o", "fitted.yaml", "--folds", "4"});
  ASSERT_EQ(fit.code, 0) << fit.err;
  for (const char* word : {"t1", "±", "4-fold cross-validation", "T_pass", "wrote fitted.yaml"}) {
    EXPECT_THAT(fit.out, HasSubstr(word));
  }
  const auto goniometer = run({"film", "goniometer", "fitted.yaml", "-o", "out", "--no-trace"});
  ASSERT_EQ(goniometer.code, 0) << goniometer.err;
  EXPECT_LT(json_of(folder_ / "out/goniometer.json")["metrics"]["both"]["table"]["theta_10"], 0.03);
}

TEST_F(FilmGoniometer, FitRefusesWhatItCannotUse) {
  const std::string data = kConfigs + "/data/";
  const auto missing = run({"film", "fit", "--reflection", "no.csv", "--transmission", "no.csv"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("no.csv"));
  const auto wrong = run({"film", "fit", "--reflection", data + "dbef.csv", "--transmission", data + "dbef.csv"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("illumination"));
  const auto folds = run({"film", "fit", "--reflection", data + "dbef_reflection_luminance.csv", "--transmission",
                          data + "dbef_transmission_luminance.csv", "--folds", "1"});
  EXPECT_EQ(folds.code, 2);
  EXPECT_THAT(folds.err, HasSubstr("--folds"));
}

TEST_F(FilmGoniometer, FitNeverReplacesItsMeasurements) {
  const std::string data = file_text(kConfigs + "/data/dbef_reflection_luminance.csv");
  write_text(folder_ / "r.csv", data);
  const auto result = run({"film", "fit", "--reflection", "r.csv", "--transmission",
                           kConfigs + "/data/dbef_transmission_luminance.csv", "-o", "./r.csv", "--overwrite"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("r.csv: must be another file than the input"));
  EXPECT_EQ(file_text(folder_ / "r.csv"), data);
}

TEST_F(FilmGoniometer, SaysWhyItSeesNothingOfAFilm) {
  const auto refusal = [&](const std::string& film) {
    write_text(folder_ / "run.yaml", "evenglow: 1\ngoniometer: {film: " + film + "}\n");
    const auto result = run({"film", "goniometer", "run.yaml", "-o", "out"});
    EXPECT_EQ(result.code, 2);
    return result.err;
  };
  EXPECT_THAT(refusal("{kind: lpp}"), HasSubstr("mueller_table, or diffuser), got a specular film"));
  EXPECT_THAT(refusal("{kind: bef}"), HasSubstr("mueller_table, or diffuser), got a film that only redirects"));
}

}  // namespace
}  // namespace evenglow::tests

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"
#include "tests/support/temp_folder.h"

/// `evenglow film reconstruct` and `evenglow film check` as a user meets them.
namespace evenglow::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kData = std::string(EVENGLOW_SOURCE_DIR) + "/configs/data/";

/// A film without scatter peaks: small enough that R + T stays below 1.
std::string four_angle_readings() {
  std::string text = "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,b0,b45,b90,b135,se\n";
  for (const char* kind : {"BRDF", "BTDF"}) {
    for (const int theta : {0, 10, 40}) text += fmt::format("{},0,0,0,{},550,0.05,0.07,,0.07,0.001\n", kind, theta);
  }
  return text;
}

/// An attenuator that does not polarize, behind and before 0, 60, 120 degrees and right circular.
std::string general_readings() {
  std::string text =
      "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,in_kind,in_angle_deg,out_kind,"
      "out_angle_deg,value,se\n";
  const char* states[] = {"linear,0", "linear,60", "linear,120", "right,"};
  for (int i = 0; i < 4; ++i) {
    for (int o = 0; o < 4; ++o) {
      const bool circular = i == 3 || o == 3;
      const double cosine = i == o ? 1.0 : circular ? 0.0 : -0.5;
      text += fmt::format("BTDF,0,0,0,0,550,{},{},{},0.001\n", states[i], states[o], 0.5 * 0.2 * (1.0 + cosine));
    }
  }
  return text;
}

TEST(FilmCheckCommand, TheDataPass) {
  const ProgramResult result = evenglow({"film", "check", kData + "dbef.csv"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("R pass"), HasSubstr("dbef.csv: good")));
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(evenglow({"film", "check", kData + "dbef.csv", "--hemispherical", kData + "dbef_hemispherical.csv"}).code,
            0);
}

TEST(FilmCheckCommand, ExitCodesTellFaultsFromUsage) {
  const TempFolder folder;
  write_text(folder / "text.csv", "not a table\n");
  const ProgramResult text = evenglow({"film", "check", "text.csv"}, folder.path());
  EXPECT_EQ(text.code, 1);
  EXPECT_THAT(text.err, StartsWith("text.csv:1:1: "));
  EXPECT_EQ(evenglow({"film", "check", "none.csv"}, folder.path()).code, 2);
  write_text(folder / "empty.csv", "");
  write_text(folder / "bad.h5", "no HDF5\n");
  for (const char* file : {"empty.csv", "bad.h5", "."}) {
    EXPECT_EQ(evenglow({"film", "check", file}, folder.path()).code, 2) << file;
  }
  EXPECT_EQ(evenglow({"film", "check"}).code, 2);
  EXPECT_EQ(evenglow({"film"}).code, 2);
}

TEST(FilmReconstructCommand, FourAnglesToATableThatCanBeChecked) {
  const TempFolder folder;
  write_text(folder / "r.csv", four_angle_readings());
  const ProgramResult made = evenglow({"film", "reconstruct", "r.csv", "-o", "film.csv"}, folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("6 nodes (BRDF 3, BTDF 3)"), HasSubstr("wrote film.csv")));
  EXPECT_THAT(file_text(folder / "film.csv"),
              AllOf(HasSubstr("tau_min_se,tau_max_se,delta_se_deg\n"), HasSubstr("\nBTDF,0,0,0,10,550,0.05,0.09,0,")));
  EXPECT_EQ(evenglow({"film", "check", "film.csv"}, folder.path()).code, 0);
  EXPECT_EQ(evenglow({"film", "reconstruct", "r.csv", "-o", "film.csv"}, folder.path()).code, 2)
      << "must not replace a file";
  EXPECT_EQ(evenglow({"film", "reconstruct", "r.csv", "-o", "film.csv", "--overwrite"}, folder.path()).code, 0);
}

TEST(FilmReconstructCommand, GeneralReadingsGiveMatricesToo) {
  const TempFolder folder;
  write_text(folder / "r.csv", general_readings());
  const ProgramResult made =
      evenglow({"film", "reconstruct", "r.csv", "-o", "film.csv", "--covariance", "--threads", "1"}, folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(file_text(folder / "film.csv"), HasSubstr(",kappa\n"));
  EXPECT_EQ(evenglow({"film", "check", "film.mueller.csv"}, folder.path()).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "film.covariance.csv"));
}

TEST(FilmReconstructCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  const auto refused = [&](const std::string& readings, const std::vector<std::string>& options) {
    write_text(folder / "r.csv", readings);
    std::vector<std::string> words{"film", "reconstruct", "r.csv", "-o", "film.csv"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramResult result = evenglow(words, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "film.csv"));
    return result.err;
  };
  EXPECT_THAT(refused(four_angle_readings(), {"--k1", "0.3", "--k2", "0.5"}), HasSubstr("must keep 0 <= k2 < k1 <= 1"));
  EXPECT_THAT(refused(four_angle_readings(), {"--angles", "screen"}), HasSubstr("screen"));
  EXPECT_THAT(refused(four_angle_readings() + "BRDF,0,0,0,70,550,1,1,1,1,0.1\n", {}),
              HasSubstr("r.csv: must hold every node of its grid, got none for BTDF"));
  const std::string general = general_readings();
  EXPECT_THAT(refused(general.substr(0, general.rfind("BTDF")), {}),
              HasSubstr("r.csv:3:1: must have readings that determine all 16 entries"));
}

TEST(FilmReconstructCommand, NeverReplacesItsReadings) {
  const TempFolder folder;
  const auto refused = [&](const std::string& in, const std::string& readings, const std::string& out) {
    write_text(folder / in, readings);
    const ProgramResult result =
        evenglow({"film", "reconstruct", in, "-o", out, "--overwrite", "--threads", "1"}, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr(in + ": must be another file than the input"));
    EXPECT_EQ(file_text(folder / in), readings);
  };
  refused("r.csv", four_angle_readings(), "r.csv");
  refused("r.csv", general_readings(), "./r.csv");
  refused("film.mueller.csv", general_readings(), "film.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "film.csv"));
  write_text(folder / "film.covariance.csv", general_readings());
  const ProgramResult covariance = evenglow(
      {"film", "reconstruct", "film.covariance.csv", "-o", "film.csv", "--covariance", "--overwrite"}, folder.path());
  EXPECT_EQ(covariance.code, 2);
  EXPECT_EQ(file_text(folder / "film.covariance.csv"), general_readings());
}

TEST(FilmReconstructCommand, OptionsOfTheAnalyzerNeedGeneralReadings) {
  const TempFolder folder;
  write_text(folder / "r.csv", four_angle_readings());
  write_text(folder / "g.csv", general_readings());
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--covariance"}, {"--analyzer-k1", "0.9"}, {"--analyzer-k2", "0.1"}}) {
    std::vector<std::string> words{"film", "reconstruct", "r.csv", "-o", "film.csv"};
    words.insert(words.end(), option.begin(), option.end());
    const ProgramResult result = evenglow(words, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err_lines().size(), 1u);
    EXPECT_THAT(result.err, StartsWith("r.csv: " + option[0] + ": needs general readings"));
    EXPECT_FALSE(std::filesystem::exists(folder / "film.csv"));
    words[2] = "g.csv";
    words.push_back("--overwrite");
    EXPECT_EQ(evenglow(words, folder.path()).code, 0);
    std::filesystem::remove(folder / "film.csv");
  }
}

TEST(FilmReconstructCommand, ReadingsMustNameTheirUnits) {
  const TempFolder folder;
  const std::string readings = four_angle_readings();
  write_text(folder / "r.csv", readings.substr(readings.find('\n') + 1));
  const ProgramResult result = evenglow({"film", "reconstruct", "r.csv", "-o", "film.csv"}, folder.path());
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, StartsWith("r.csv:1:1: the comment must name the units degrees, nm and 1/sr"));
  EXPECT_FALSE(std::filesystem::exists(folder / "film.csv"));
}

TEST(FilmReconstructCommand, HelpTellsUnitsDefaultsAndAnExample) {
  const ProgramResult help = evenglow({"film", "reconstruct", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("1/sr"), HasSubstr("default"), HasSubstr("Example: evenglow film reconstruct")));
}

}  // namespace
}  // namespace evenglow::tests

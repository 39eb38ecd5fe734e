#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"
#include "tests/support/temp_folder.h"

/// `evenglow film convert`, and HDF5 tables where the other commands take tables.
namespace evenglow::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kData = std::string(EVENGLOW_SOURCE_DIR) + "/configs/data/";

/// A table whose numbers need all 17 digits, in no order.
constexpr const char* kTable =
    "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n"
    "BTDF,0,0,0,80,650,0.010000000000000002,0.020000000000000004,89.99999999999999\n"
    "BTDF,0,0,0,80,450,1e-300,0.03,0\n"
    "BTDF,0,0,0,0,650,0.30000000000000004,0.30000000000000004,-45\n"
    "BTDF,0,0,0,0,450,0.1,0.2,0\n";

TEST(FilmConvertCommand, ThereAndBackKeepsEveryDigit) {
  const TempFolder folder;
  write_text(folder / "a.csv", kTable);
  const ProgramResult made = evenglow({"film", "convert", "a.csv", "a.h5"}, folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out, "wrote a.h5: 4 nodes of tau_min, tau_max, delta\n");
  EXPECT_THAT(file_text(folder / "a.h5"), StartsWith("Evenglow HDF5, SHA-256"));
  ASSERT_EQ(evenglow({"film", "convert", "a.h5", "b.csv"}, folder.path()).code, 0);
  EXPECT_EQ(file_text(folder / "b.csv"),
            "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n"
            "BTDF,0,0,0,0,450,0.1,0.2,0\n"
            "BTDF,0,0,0,0,650,0.30000000000000004,0.30000000000000004,-45\n"
            "BTDF,0,0,0,80,450,1e-300,0.03,0\n"
            "BTDF,0,0,0,80,650,0.010000000000000002,0.020000000000000004,89.99999999999999\n");
  // And the file made from that is the same, byte by byte.
  ASSERT_EQ(evenglow({"film", "convert", "b.csv", "b.hdf5"}, folder.path()).code, 0);
  EXPECT_EQ(file_text(folder / "a.h5"), file_text(folder / "b.hdf5"));
}

TEST(FilmConvertCommand, RefusesInOneLineAndWritesNothing) {
  const TempFolder folder;
  write_text(folder / "a.csv", kTable);
  write_text(folder / "bad.h5", "no HDF5\n");
  write_text(folder / "there.h5", "precious");
  const auto refused = [&](const std::string& in, const std::string& out) {
    const ProgramResult result = evenglow({"film", "convert", in, out}, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
    return result.err;
  };
  EXPECT_THAT(refused("bad.h5", "x.csv"), HasSubstr("bad.h5: must be an HDF5 file, got none"));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.csv"));
  EXPECT_THAT(refused("none.csv", "x.h5"), HasSubstr("none.csv"));
  EXPECT_THAT(refused("a.csv", "a.csv"), HasSubstr("must be another file than the input"));
  std::filesystem::create_hard_link(folder / "a.csv", folder / "same.csv");
  EXPECT_THAT(refused("a.csv", "same.csv"), HasSubstr("same.csv: must be another file than the input"));
  refused("a.csv", "there.h5");
  EXPECT_EQ(file_text(folder / "there.h5"), "precious");
  EXPECT_EQ(evenglow({"film", "convert", "a.csv", "there.h5", "--overwrite"}, folder.path()).code, 0);
}

TEST(FilmConvertCommand, FilmCheckTakesHdf5) {
  const TempFolder folder;
  ASSERT_EQ(evenglow({"film", "convert", kData + "dbef.csv", "dbef.h5"}, folder.path()).code, 0);
  const ProgramResult csv = evenglow({"film", "check", kData + "dbef.csv"});
  const ProgramResult h5 = evenglow({"film", "check", "dbef.h5"}, folder.path());
  EXPECT_EQ(h5.code, 0) << h5.err;
  EXPECT_THAT(h5.out, HasSubstr("dbef.h5: good"));
  // The same figures; only the name differs.
  const auto figures = [](const std::string& text) { return text.substr(0, text.find("R, T:")); };
  EXPECT_EQ(figures(h5.out), figures(csv.out));
  write_text(folder / "cut.h5", file_text(folder / "dbef.h5").substr(0, 20000));
  const ProgramResult cut = evenglow({"film", "check", "cut.h5"}, folder.path());
  EXPECT_EQ(cut.code, 2) << "no table to judge";
  EXPECT_THAT(cut.err, StartsWith("cut.h5: must have the SHA-256 that its first line tells"));
  EXPECT_EQ(cut.err_lines().size(), 1u) << cut.err;
}

TEST(FilmConvertCommand, ReconstructWritesHdf5) {
  std::string text =
      "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,in_kind,in_angle_deg,"
      "out_kind,out_angle_deg,value,se\n";
  const char* states[] = {"linear,0", "linear,60", "linear,120", "right,"};
  for (int i = 0; i < 4; ++i) {
    for (int o = 0; o < 4; ++o) {
      const double cosine = i == o ? 1.0 : (i == 3 || o == 3) ? 0.0 : -0.5;
      text += "BTDF,0,0,0,0,550," + std::string(states[i]) + "," + states[o] + "," +
              std::to_string(0.1 * (1.0 + cosine)) + ",0.001\n";
    }
  }
  const TempFolder folder;
  write_text(folder / "r.csv", text);
  const ProgramResult made =
      evenglow({"film", "reconstruct", "r.csv", "-o", "film.h5", "--covariance", "--threads", "1"}, folder.path());
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("wrote film.h5"), HasSubstr("wrote film.mueller.h5"),
                              HasSubstr("wrote film.covariance.csv")));
  EXPECT_EQ(evenglow({"film", "check", "film.h5"}, folder.path()).code, 0);
  const ProgramResult mueller = evenglow({"film", "check", "film.mueller.h5"}, folder.path());
  EXPECT_EQ(mueller.code, 0) << mueller.err;
  EXPECT_THAT(mueller.out, AllOf(HasSubstr("R pass"), HasSubstr("film.mueller.h5: good")));
  ASSERT_EQ(evenglow({"film", "convert", "film.mueller.h5", "m.csv"}, folder.path()).code, 0);
  EXPECT_THAT(file_text(folder / "m.csv"), HasSubstr("frames turned to the film axis"));
}

}  // namespace
}  // namespace evenglow::tests

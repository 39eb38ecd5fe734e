#include <algorithm>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/key_explorer.h"
#include "tests/app/tiny_run.h"

/// The schema of the run file and the key reference, made from the declarations that read it.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

const fs::path kSource = EVENGLOW_SOURCE_DIR;

class KeySchema : public ::testing::Test {
 protected:
  /// `accepted ...` or `rejected ...` for each file, by an independent validator.
  std::vector<std::string> judged(const std::vector<fs::path>& files) const {
    const ProgramResult schema = evenglow({"schema"});
    EXPECT_EQ(schema.code, 0) << schema.err;
    write_text(folder_ / "schema.json", schema.out);
    std::vector<std::string> words = {"/usr/bin/python3", (kSource / "tests/support/validate_run_files.py").string(),
                                      (folder_ / "schema.json").string()};
    for (const fs::path& file : files) words.push_back(file.string());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err;
    std::vector<std::string> lines;
    std::istringstream stream(result.out);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    EXPECT_EQ(lines.size(), files.size());
    return lines;
  }

  static std::vector<fs::path> run_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }

  TempFolder folder_;
};

TEST_F(KeySchema, AcceptsEveryShippedRunFile) {
  std::vector<fs::path> files = run_files(kSource / "configs");
  const auto studies = run_files(kSource / "configs/studies");
  files.insert(files.end(), studies.begin(), studies.end());
  std::erase(files, kSource / "configs/dbef_goniometer.yaml");  // a file of the goniometer is no run file
  ASSERT_GE(files.size(), 10u);
  for (const std::string& line : judged(files)) EXPECT_THAT(line, ::testing::StartsWith("accepted")) << line;
}

constexpr const char* kParts = R"(backlight:
  light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}
  microstructure: {cells: [8, 4]}
)";

/// A run file with one row of LEDs of these keys, and these lines at the top.
std::string with(const std::string& leds, const std::string& top) {
  return std::string("evenglow: 1\n") + kParts + "  sources: [{kind: led_row, pitch_mm: 0.4, size_mm: [0.3, 0.3]" +
         leds + "}]\n  films: [{kind: diffuser}]\ntrace: {photons: 1e4}\n" + top;
}

TEST_F(KeySchema, JudgesAsTheProgramDoes) {
  struct Case {
    const char* name;
    std::string text;
    bool allowed;
  };
  const std::string plain = with("", "");
  const std::vector<Case> cases = {
      {"plain", plain, true},
      {"max_efficiency", with("", "design: {goal: max_efficiency, subject_to: {rms: 0.02}}\n"), true},
      {"min_rms", with("", "design: {goal: min_rms, subject_to: {efficiency: 0.5}}\n"), true},
      {"color_bound",
       with("", "design: {subject_to: {color: 0.004}}\n")
           .replace(plain.find("trace"), 0, "  receivers: [{kind: luminance}, {kind: color}]\n"),
       true},
      {"views",
       with("", "").replace(plain.find("trace"), 0,
                            "  receivers: [{kind: luminance, views: [{direction_deg: [30, 90], weight: 2}]}]\n"),
       true},
      {"view_weight",
       with("", "").replace(plain.find("trace"), 0,
                            "  receivers: [{kind: luminance, views: [{direction_deg: [30, 90], weight: 0}]}]\n"),
       false},
      {"bilinear",
       with("", "").replace(plain.find("cells: [8, 4]"), 13, "cells: [8, 4], interpolation: bilinear, subcells: 3"),
       true},
      {"bound_range", with("", "design: {goal: min_rms, subject_to: {efficiency: 1.5}}\n"), false},
      {"off_beyond_the_default", with(", count: 20, off: [15]", ""), true},
      {"off_zero", with(", count: 20, off: [0]", ""), false},
      {"include", "include: plain.yaml\ntitle: more\n", true},
      {"include_part", std::string("evenglow: 1\nbacklight: {include: part.yaml}\n"), true},
      {"include_beside_unknown", "include: plain.yaml\nbacklite: {}\n", false},
      {"include_version_2", "include: plain.yaml\nevenglow: 2\n", false},
      {"version_float", "evenglow: 1.5\n" + plain.substr(plain.find('\n') + 1), false},
      {"version_zero", "evenglow: 0\n" + plain.substr(plain.find('\n') + 1), false},
      {"backlight_none", "evenglow: 1\ntrace: {photons: 1e4}\n", false},
      {"output_none", with("", "output: []\n"), false},
      {"output_one", with("", "output: [json]\n"), true},
      {"edges_none", with("", "").replace(plain.find("thickness"), 0, "entrance: {edges: []}, "), true},
  };
  write_text(folder_ / "part.yaml", plain.substr(plain.find("  light"), plain.find("trace") - plain.find("  light")));
  std::vector<fs::path> files;
  for (const Case& c : cases) {
    files.push_back(folder_ / (std::string(c.name) + ".yaml"));
    write_text(files.back(), c.text);
  }
  const auto lines = judged(files);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(lines[i].starts_with("accepted"), cases[i].allowed) << lines[i];
    const ProgramResult program = evenglow({"check", files[i].string()});
    EXPECT_EQ(program.code == 0, cases[i].allowed) << files[i] << "\n" << program.err;
  }
}

/// What a schema cannot know: keys that a value or another key of the same kind decides on, key paths of variants,
/// files, YAML itself.
const std::set<std::string> kBeyondASchema = {
    "diffuser_table_haze",        "exponent_without_pattern", "variant_unknown_key", "variant_wrong_value",
    "variant_film_outside_stack", "density_limits_swapped",   "pattern_behind",      "microlens_fill"};

TEST_F(KeySchema, RejectsEveryRunFileWithAFaultOfStructure) {
  const std::vector<fs::path> files = run_files(kSource / "tests/app/faulty");
  const auto lines = judged(files);
  const std::regex structure(
      "unknown key|must be (a map|a list|one of|true or false|an integer|a number(,| such)|a whole number|whole "
      "numbers)|"
      "must lie in \\[|must hold \\d+ numbers");
  int rejected = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (lines[i].starts_with("rejected")) {
      ++rejected;
      continue;
    }
    const ProgramResult program = evenglow({"check", files[i].string()});
    const bool known = kBeyondASchema.contains(files[i].stem().string());
    const bool of_a_table = std::regex_search(program.err, std::regex("\\.(csv|dat|ies|ldt|sdf|tm25ray):"));
    EXPECT_TRUE(known || of_a_table || !std::regex_search(program.err, structure))
        << files[i] << "\n"
        << program.err << "accepted by the schema";
  }
  EXPECT_GE(rejected, 80);
}

TEST_F(KeySchema, TheReferenceInTheDocumentationIsOfThisProgram) {
  const ProgramResult reference = evenglow({"schema", "--reference"});
  ASSERT_EQ(reference.code, 0) << reference.err;
  EXPECT_TRUE(reference.out == file_text(kSource / "docs/keys.md"))
      << "write it anew: evenglow schema --reference > docs/keys.md";
}

TEST(KeyExplorer, FindsKeysThatOthersDecideOn) {
  const auto keys = app::explore_keys();
  const auto has = [&](const std::string& node, const std::string& kind, const std::string& key) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](const core::DeclaredKey& k) { return k.node == node && k.kind == kind && k.key == key; });
  };
  EXPECT_TRUE(has("backlight.films[]", "bef", "apex_deg"));
  EXPECT_TRUE(has("backlight.films[]", "dbef", "hemispherical")) << "read beside a table only";
  EXPECT_TRUE(has("backlight.light_guide_plate.dispersion", "sellmeier", "c_um2"));
  EXPECT_TRUE(has("backlight.microstructure", "microlens", "aspect"));
  EXPECT_TRUE(has("backlight.size", "", "length_mm")) << "read without a plate only";
  EXPECT_FALSE(has("backlight.films[]", "lpp", "apex_deg"));
}

TEST(KeyExplorer, RequiresOnlyWhatEveryReadingDemands) {
  const auto keys = app::explore_keys();
  const auto required = [&](const std::string& node, const std::string& key) {
    const auto found = std::find_if(keys.begin(), keys.end(),
                                    [&](const core::DeclaredKey& k) { return k.node == node && k.key == key; });
    EXPECT_NE(found, keys.end()) << node << " " << key;
    return found != keys.end() && found->required;
  };
  EXPECT_TRUE(required("", "evenglow"));
  EXPECT_TRUE(required("", "backlight"));
  EXPECT_TRUE(required("backlight.films[]", "kind"));
  EXPECT_TRUE(required("optimize[]", "range"));
  EXPECT_FALSE(required("design.subject_to", "rms")) << "demanded by one goal only";
  EXPECT_FALSE(required("design.subject_to", "efficiency")) << "demanded by one goal only";
}

}  // namespace
}  // namespace evenglow::tests

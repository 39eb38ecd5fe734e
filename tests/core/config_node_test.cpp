#include "core/config/config_node.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/units.h"
#include "tests/core/config_reading.h"

namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Range kAngle{0, 180, false, true};

Reader reads(const std::function<void(const ConfigNode&)>& read) {
  return read;
}

// ---------------------------------------------------------------- lists

NumbersKey cells() {
  return {"cells", "columns and rows", Range{1, 1000}, 2, 2, {}, true};
}

TEST(ConfigNode, NumberListsAreCheckedItemByItem) {
  const Reader read = [](const ConfigNode& node) { EXPECT_GE(node.numbers(cells()).size(), 2u); };
  EXPECT_THAT(faults_of("cells: [96, 48]", read), IsEmpty());
  EXPECT_THAT(faults_of("cells: [0, x]", read), ElementsAre("run.yaml:1:9: cells[0]: must lie in [1, 1000], got 0",
                                                            "run.yaml:1:12: cells[1]: must be a number, got x"));
  EXPECT_THAT(faults_of("cells: [1.5, 2]", read),
              ElementsAre("run.yaml:1:9: cells[0]: must be a whole number, got 1.5"));
  EXPECT_THAT(faults_of("cells: [96]", read), ElementsAre("run.yaml:1:8: cells: must hold 2 numbers, got 1"));
  EXPECT_THAT(faults_of("cells: 96", read), ElementsAre("run.yaml:1:8: cells: must be a list of numbers, got 96"));
  EXPECT_THAT(faults_of("cells: [[1], ]", read), ElementsAre("run.yaml:1:8: cells: must hold 2 numbers, got 1"));
  EXPECT_THAT(faults_of("cells:", read), ElementsAre("run.yaml:1:1: cells: must be a list of numbers, got nothing"));
  EXPECT_THAT(faults_of("{}", read), ElementsAre("run.yaml:1:1: cells: must be given (columns and rows)"));
}

TEST(ConfigNode, NumberListsConvertUnitsAndFallBack) {
  EXPECT_THAT(
      faults_of(
          "a_um: [1, 2]", reads([](const ConfigNode& node) {
            EXPECT_THAT(node.numbers({"a_um", "", Range::any()}), ElementsAre(0.001, 0.002));
            EXPECT_THAT(node.numbers({"b_um", "", Range::any(), 0, 9, std::vector<double>{5}}), ElementsAre(0.005));
          })),
      ElementsAre());
  EXPECT_THAT(faults_of("a: [1, 2, 3]", reads([](const ConfigNode& node) {
                          node.numbers({"a", "", Range::any(), 4, 9});
                        })),
              ElementsAre("run.yaml:1:4: a: must hold at least 4 numbers, got 3"));
  EXPECT_THAT(faults_of("a: [1, 2, 3]", reads([](const ConfigNode& node) {
                          node.numbers({"a", "", Range::any(), 0, 2});
                        })),
              ElementsAre("run.yaml:1:4: a: must hold at most 2 numbers, got 3"));
}

TEST(ConfigNode, WordListsRefuseStrangersAndRepeats) {
  const ChoiceKey key{"output", "", {"json", "csv", "png"}, "json,csv"};
  const Reader read = [&](const ConfigNode& node) { node.choices(key); };
  EXPECT_THAT(faults_of("output: [csv, png]", reads([&](const ConfigNode& node) {
                          EXPECT_THAT(node.choices(key), ElementsAre("csv", "png"));
                        })),
              IsEmpty());
  EXPECT_THAT(faults_of("{}", reads([&](const ConfigNode& node) {
                          EXPECT_THAT(node.choices(key), ElementsAre("json", "csv"));
                        })),
              IsEmpty());
  EXPECT_THAT(faults_of("output: csv", read), ElementsAre("run.yaml:1:9: output: must be a list of words, got csv"));
  EXPECT_THAT(faults_of("output: [csv, cvs, csv]", read),
              ElementsAre("run.yaml:1:15: output[1]: must be one of json, csv, png; got cvs, did you mean `csv`?",
                          "run.yaml:1:20: output[2]: must not be given twice, got csv"));
}

TEST(ConfigNode, ListsOfMapsCarryTheirIndexAndSkipWrongItems) {
  const Reader read = [](const ConfigNode& node) {
    for (const ConfigNode& film : node.map("backlight", "").maps("films", "", 3))
      film.number({"axis_deg", "", kAngle, {}});
  };
  EXPECT_THAT(faults_of("backlight:\n  films:\n    - axis_deg: 0\n    - axis_deg: 270\n", read),
              ElementsAre("run.yaml:4:17: backlight.films[1].axis_deg: must lie in [0, 180), got 270"));
  EXPECT_THAT(faults_of("backlight: {films: [dbef, {axis_deg: 1}]}", read),
              ElementsAre("run.yaml:1:21: backlight.films[0]: must be a map, got dbef"));
  EXPECT_THAT(faults_of("backlight: {films: {axis_deg: 1}}", read),
              ElementsAre("run.yaml:1:20: backlight.films: must be a list of maps, got a map"));
  EXPECT_THAT(faults_of("backlight: {films: [{}, {}, {}, {}]}", read),
              ElementsAre("run.yaml:1:20: backlight.films: must hold at most 3 maps, got 4"));
  EXPECT_THAT(faults_of("backlight: {films:}", read),
              ElementsAre("run.yaml:1:13: backlight.films: must be a list of maps, got nothing"));
}

// ---------------------------------------------------------------- maps, absence, unread keys

Reader plate_reader() {
  return [](const ConfigNode& root) {
    const ConfigNode plate = root.map("plate", "the plate", true);
    plate.number({"thickness_mm", "thickness of the plate", Range::positive(100), {}});
    plate.number({"length_mm", "length of the plate", Range::positive(1000), 140.0});
    root.map("trace", "the trace").count({"photons", "photons of the trace", 1, 1000000000, 1000});
  };
}

TEST(ConfigNode, AnAbsentRequiredMapIsOneFault) {
  EXPECT_THAT(faults_of("trace: {photons: 2}", plate_reader()),
              ElementsAre("run.yaml:1:1: plate: must be given (the plate)"));
}

TEST(ConfigNode, AWrongMapIsOneFault) {
  EXPECT_THAT(faults_of("plate: 5", plate_reader()), ElementsAre("run.yaml:1:8: plate: must be a map, got 5"));
  EXPECT_THAT(faults_of("plate: [{thickness_mm: 1}]", plate_reader()),
              ElementsAre("run.yaml:1:8: plate: must be a map, got a list"));
  EXPECT_THAT(faults_of("plate:", plate_reader()), ElementsAre("run.yaml:1:1: plate: must be a map, got nothing"));
}

TEST(ConfigNode, AMissingKeyIsToldAtItsMap) {
  EXPECT_THAT(faults_of("trace: {}\nplate:\n  length_mm: 7\n", plate_reader()),
              ElementsAre("run.yaml:3:3: plate.thickness_mm: must be given (thickness of the plate)"));
}

TEST(ConfigNode, AbsentMapsGiveFallbacks) {
  EXPECT_THAT(faults_of("plate: {thickness_mm: 1}", reads([](const ConfigNode& root) {
                          root.map("plate", "").mark_read();
                          const ConfigNode inner = root.map("design", "").map("stop", "");
                          EXPECT_FALSE(inner.present());
                          EXPECT_EQ(inner.path(), "design.stop");
                          EXPECT_EQ(inner.number({"angle_deg", "", kAngle, 90.0}), kPi / 2);
                          EXPECT_EQ(inner.text({"t", "", "x"}), "x");
                          EXPECT_EQ(inner.integer({"i", "", 0, 9, 3}), 3);
                          EXPECT_TRUE(inner.boolean({"b", "", true}));
                          EXPECT_THAT(inner.maps("m", ""), IsEmpty());
                          EXPECT_THAT(inner.entries(), IsEmpty());
                        })),
              IsEmpty());
}

TEST(ConfigNode, ARequiredKeyOfAnAbsentOptionalMapIsMissing) {
  EXPECT_THAT(faults_of("a: 1", reads([](const ConfigNode& root) {
                          root.number({"a", "", Range::any(), {}});
                          root.map("b", "").map("c", "").number({"d", "", Range::any(), {}});
                        })),
              ElementsAre("run.yaml:1:1: b.c.d: must be given"));
}

struct UnreadCase {
  const char* yaml;
  Lines faults;
};

class UnreadKeys : public ::testing::TestWithParam<UnreadCase> {};

TEST_P(UnreadKeys, AreFaultsThatNameWhatWasMeant) {
  EXPECT_EQ(faults_of(GetParam().yaml, plate_reader()), GetParam().faults);
}

INSTANTIATE_TEST_SUITE_P(
    Advice, UnreadKeys,
    ::testing::Values(UnreadCase{"plate: {thicknes_mm: 1}",
                                 {"run.yaml:1:9: plate.thicknes_mm: unknown key, did you mean `thickness_mm`?"}},
                      UnreadCase{"plate: {thickness_mm: 1, lenght_mm: 1}",
                                 {"run.yaml:1:26: plate.lenght_mm: unknown key, did you mean `length_mm`?"}},
                      UnreadCase{
                          "plate: {thickness_cm: 1}",
                          {"run.yaml:1:9: plate.thickness_cm: unknown key, the unit must be mm: `thickness_mm`"}},
                      UnreadCase{"plate: {thickness: 1}",
                                 {"run.yaml:1:9: plate.thickness: unknown key, the unit must be mm: `thickness_mm`"}},
                      UnreadCase{"plate: {thickness_mm: 1, length_per_m: 1}",
                                 {"run.yaml:1:26: plate.length_per_m: unknown key, the unit must be mm: `length_mm`"}},
                      UnreadCase{"plate: {thickness_mm: 1, color: 1}",
                                 {"run.yaml:1:26: plate.color: unknown key, known here: thickness_mm, length_mm"}},
                      UnreadCase{"plate: {thickness_mm: 1, length_mm:5}",
                                 {"run.yaml:1:26: plate.length_mm:5: unknown key, did you mean `length_mm`?"}},
                      UnreadCase{"plate: {thickness_mm: 1}\nTrace: {photons: 1, x: 2}",
                                 {"run.yaml:2:1: Trace: unknown key, did you mean `trace`?"}}));

TEST(ConfigNode, LongAndOddUnknownKeysStayOnOneLine) {
  const Lines faults =
      faults_of("plate: {thickness_mm: 1}\n\"" + std::string(100, 'k') + "\": 1\n\"a\\nb\": 2", plate_reader());
  EXPECT_THAT(faults,
              ElementsAre("run.yaml:2:1: " + std::string(60, 'k') + "...: unknown key, known here: plate, trace",
                          "run.yaml:3:1: a\\nb: unknown key, known here: plate, trace"));
}

TEST(ConfigNode, KeysBelowAMapThatNobodyReadAreToldOnlyIfNothingElseIsWrong) {
  const Reader shallow = [](const ConfigNode& root) { root.map("a", ""); };
  EXPECT_THAT(faults_of("a: {x: 1}", shallow), ElementsAre("run.yaml:1:5: a.x: unknown key"));
  const Reader faulty = [](const ConfigNode& root) {
    root.map("a", "");
    root.number({"n", "", Range::any(), {}});
  };
  EXPECT_THAT(faults_of("a: {x: 1}\nn: m", faulty), ElementsAre("run.yaml:2:4: n: must be a number, got m"));
}

TEST(ConfigNode, EntriesHaveFreeKeysWhoseMapsAreStillJudged) {
  EXPECT_THAT(faults_of("sides: {top: {gap_mm: 1}, left: {gap_m: 1}}", reads([](const ConfigNode& root) {
                          std::vector<std::string> names;
                          for (const auto& [name, side] : root.map("sides", "").entries()) {
                            names.push_back(name);
                            side.number({"gap_mm", "", Range::any(), 0.0});
                          }
                          EXPECT_THAT(names, ElementsAre("top", "left"));
                        })),
              ElementsAre("run.yaml:1:34: sides.left.gap_m: unknown key, the unit must be mm: `gap_mm`"));
}

TEST(ConfigNode, ItemsAndYamlGiveFreeValues) {
  const Reader read = [](const ConfigNode& root) {
    const auto entries = root.map("sweep", "").entries();
    ASSERT_EQ(entries.size(), 1u);
    Lines values;
    for (const ConfigNode& item : entries[0].second.items()) values.push_back(item.yaml());
    EXPECT_THAT(values, ElementsAre("-1.5", "\"5\"", "{kind: lpp, x: [1, 2]}", "\"a \\\"b\\\"\\n\xc3\xbc\"", "null"));
    root.map("sweep", "").mark_read();
  };
  EXPECT_THAT(faults_of("sweep: {a.b: [-1.5, '5', {kind: lpp, x: [1, 2]}, \"a \\\"b\\\"\\n\xc3\xbc\", null]}", read),
              IsEmpty());
}

TEST(ConfigNode, FaultsOfReadersAreNotedOnceAndNotOnRefusedKeys) {
  const Reader read = [](const ConfigNode& root) {
    root.number({"a", "", Range::any(), {}});
    root.number({"b", "", Range::any(), {}});
    root.fault_at("a", "must be less than b");
    root.fault_at("b", "must be more than a, got\n1");
    root.fault_at("b", "must be more than a, got\n1");
    root.fault("must make sense");
  };
  EXPECT_THAT(faults_of("a: x\nb: 1", read),
              ElementsAre("run.yaml:1:1: must make sense", "run.yaml:1:4: a: must be a number, got x",
                          "run.yaml:2:4: b: must be more than a, got\\n1"));
}

TEST(ConfigNode, GuardedTurnsWhatIsThrownIntoFaults) {
  const Reader read = [](const ConfigNode& root) {
    root.text({"table", "", {}});
    EXPECT_EQ(root.guarded("table", [] { return 5; }), 5);
    EXPECT_EQ(root.guarded("table", []() -> int { throw Error("no memory"); }), std::nullopt);
    EXPECT_EQ(
        root.guarded(
            "table",
            []() -> int {
              throw ConfigError(std::vector<Fault>{{"t.csv", 2, 1, "tau", "must be 1"}, {"t.csv", 3, 1, "", "bad"}});
            }),
        std::nullopt);
  };
  EXPECT_THAT(faults_of("table: t.csv", read),
              ElementsAre("run.yaml:1:8: table: no memory", "run.yaml:1:8: table: t.csv:2:1: tau: must be 1",
                          "run.yaml:1:8: table: t.csv:3:1: bad"));
}

TEST(ConfigNode, AllFaultsComeInTheOrderOfLines) {
  EXPECT_THAT(
      faults_of("plate:\n  thickness_mm: 0\n  length_mm: [1]\n  width: 3\ntrace: {photons: 0.5}\nx: 1", plate_reader()),
      ElementsAre("run.yaml:2:17: plate.thickness_mm: must lie in (0, 100], got 0",
                  "run.yaml:3:14: plate.length_mm: must be a number, got a list",
                  "run.yaml:4:3: plate.width: unknown key, known here: thickness_mm, length_mm",
                  "run.yaml:5:18: trace.photons: must be a whole number (20e6 is one too), got 0.5",
                  "run.yaml:6:1: x: unknown key, known here: plate, trace"));
}

TEST(ConfigNode, VeryManyFaultsAreCounted) {
  std::string text = "plate: {thickness_mm: 1}\n";
  for (int i = 0; i < 250; ++i) text += "odd" + std::to_string(i) + ": 1\n";
  const Lines faults = faults_of(text, plate_reader());
  ASSERT_EQ(faults.size(), 101u);
  EXPECT_EQ(faults.back(), "run.yaml: and 150 more faults");
}

// ---------------------------------------------------------------- declarations

TEST(ConfigDocument, RemembersDeclarationsOnceForEachKindOfNode) {
  ConfigDocument document = ConfigDocument::parse("films: [{kind: bef}, {kind: lpp}, {kind: bef}]", "run.yaml");
  for (const ConfigNode& film : document.root().maps("films", "the films", 50)) {
    const auto kind = film.kind({"kind", "which film", {"bef", "lpp"}, {}});
    if (kind == "bef") film.number({"axis_deg", "axis of the prisms", kAngle, 0.0});
    if (kind == "lpp") film.choices({"sides", "which sides", {"up", "down"}, "up"});
  }
  document.finish();
  const auto& declared = document.declared();
  ASSERT_EQ(declared.size(), 4u);
  EXPECT_EQ(declared[0].type, "maps");
  EXPECT_EQ(declared[0].max_count, 50u);
  EXPECT_EQ(declared[1].node, "films[]");
  EXPECT_EQ(declared[1].key, "kind");
  EXPECT_TRUE(declared[1].required);
  EXPECT_THAT(declared[1].options, ElementsAre("bef", "lpp"));
  EXPECT_EQ(declared[2].kind, "bef");
  EXPECT_EQ(declared[2].unit, "deg");
  EXPECT_EQ(declared[2].range->to_string(), "[0, 180)");
  EXPECT_EQ(declared[2].fallback, "0");
  EXPECT_EQ(declared[2].help, "axis of the prisms");
  EXPECT_EQ(declared[3].kind, "lpp");
  EXPECT_EQ(declared[3].fallback, "[up]");
}

// ---------------------------------------------------------------- files

class ConfigFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / ("config_files_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "data");
    std::ofstream(folder_ / "data" / "dbef.csv") << "x\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Lines faults(const std::string& text) {
    std::ofstream(folder_ / "run.yaml") << text;
    ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
    got_ = document.root().file({"table", "the film's table", {}});
    try {
      document.finish();
    } catch (const ConfigError& error) {
      return lines_of(error);
    }
    return {};
  }
  std::string where(const std::string& rest) const { return (folder_ / "run.yaml").string() + rest; }

  std::filesystem::path folder_;
  std::filesystem::path got_;
};

TEST_F(ConfigFiles, CountFromTheFolderOfTheRunFile) {
  EXPECT_THAT(faults("table: data/dbef.csv"), IsEmpty());
  EXPECT_EQ(got_, folder_ / "data/dbef.csv");
  EXPECT_THAT(faults("table: " + (folder_ / "data/dbef.csv").string()), IsEmpty());
}

TEST_F(ConfigFiles, MustBeRegularFiles) {
  EXPECT_THAT(faults("table: data/dbfe.csv"),
              ElementsAre(where(":1:8: table: must be an existing file, found none at ") +
                          (folder_ / "data/dbfe.csv").string()));
  EXPECT_EQ(got_, "");
  EXPECT_THAT(faults("table: data"),
              ElementsAre(where(":1:8: table: must be a file, got the directory ") + (folder_ / "data").string()));
  EXPECT_THAT(faults("table: /dev/zero"),
              ElementsAre(where(":1:8: table: must be a regular file, got a pipe, socket or device at /dev/zero")));
  EXPECT_THAT(faults("table: ''"), ElementsAre(where(":1:8: table: must be the name of a file, got \"\"")));
  EXPECT_THAT(faults("table: \"a\\0b\""),
              ElementsAre(where(":1:8: table: must be the name of a file, got \"a\\x00b\"")));
  EXPECT_THAT(faults("table: [a]"), ElementsAre(where(":1:8: table: must be text, got a list")));
  EXPECT_THAT(faults("{}"), ElementsAre(where(":1:1: table: must be given (the film's table)")));
}

TEST(ConfigDocument, ParsedTextHasTheFolderOfItsName) {
  EXPECT_EQ(ConfigDocument::parse("{}", "configs/run.yaml").folder(), "configs");
  const ConfigDocument document = ConfigDocument::parse("table: none.csv", "configs/run.yaml");
  document.root().file({"table", "", {}});
  try {
    document.finish();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "configs/run.yaml:1:8: table: must be an existing file, found none at configs/none.csv");
  }
}

}  // namespace
}  // namespace evenglow::core

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config_node.h"
#include "tests/core/config_reading.h"

/// Overrides and variants.
namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Override = ConfigDocument::Override;

constexpr const char* kRun = "trace: {photons: 100}\nbacklight:\n  films: [{kind: bef, axis_deg: 0}, {kind: dbef}]\n";

/// The whole document as one line of YAML after the changes; the faults come second.
std::pair<std::string, Lines> applied(const std::vector<Override>& changes, const std::string& text = kRun) {
  ConfigDocument document = ConfigDocument::parse(text, "run.yaml");
  for (const Override& change : changes) document.apply(change);
  document.root().mark_read();
  try {
    document.finish();
  } catch (const ConfigError& error) {
    return {document.root().yaml(), lines_of(error)};
  }
  return {document.root().yaml(), {}};
}

struct OverrideCase {
  const char* path;
  const char* yaml;
  const char* result;
};

class Overrides : public ::testing::TestWithParam<OverrideCase> {};

TEST_P(Overrides, ReplaceAndAdd) {
  const auto [yaml, faults] = applied({{GetParam().path, GetParam().yaml, "--set"}});
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_EQ(yaml, GetParam().result);
}

INSTANTIATE_TEST_SUITE_P(
    Paths, Overrides,
    ::testing::Values(
        OverrideCase{"trace.photons", "1e6",
                     "{trace: {photons: 1e6}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: dbef}]}}"},
        OverrideCase{"backlight.films[1]", "{kind: lpp}",
                     "{trace: {photons: 100}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: lpp}]}}"},
        OverrideCase{"backlight.films[0]", "{kind: lpp}",
                     "{trace: {photons: 100}, backlight: {films: [{kind: lpp}, {kind: dbef}]}}"},
        OverrideCase{
            "backlight.films[2].kind", "lpp",
            "{trace: {photons: 100}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: dbef}, {kind: lpp}]}}"},
        OverrideCase{"backlight.films", "[]", "{trace: {photons: 100}, backlight: {films: []}}"},
        OverrideCase{
            "design.stop.rms", "0.01",
            "{trace: {photons: 100}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: dbef}]}, design: {stop: "
            "{rms: 0.01}}}"},
        OverrideCase{
            "output[0]", "json",
            "{trace: {photons: 100}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: dbef}]}, output: [json]}"},
        OverrideCase{"m[0][0].a", "'5'",
                     "{trace: {photons: 100}, backlight: {films: [{kind: bef, axis_deg: 0}, {kind: dbef}]}, m: [[{a: "
                     "\"5\"}]]}"}));

struct FaultyOverride {
  const char* path;
  const char* yaml;
  const char* fault;
};

class FaultyOverrides : public ::testing::TestWithParam<FaultyOverride> {};

TEST_P(FaultyOverrides, AreFaultsOfTheirOrigin) {
  EXPECT_THAT(applied({{GetParam().path, GetParam().yaml, "--set"}}).second, ElementsAre(GetParam().fault));
}

constexpr const char* kNoPath = "must be a key path such as trace.photons or backlight.films[1].axis_deg";

INSTANTIATE_TEST_SUITE_P(
    Paths, FaultyOverrides,
    ::testing::Values(
        FaultyOverride{"backlight.films[3]", "{kind: lpp}",
                       "--set: backlight.films: holds 2 items, the index must lie in [0, 2], got 3"},
        FaultyOverride{"backlight.films.kind", "lpp",
                       "--set: backlight.films: must be a map to hold the key `kind`, got a list"},
        FaultyOverride{"trace.photons.x", "1", "--set: trace.photons: must be a map to hold the key `x`, got 100"},
        FaultyOverride{"trace[0]", "1", "--set: trace: must be a list to hold an index, got a map"},
        FaultyOverride{"variants.lpp", "{}", "--set: variants.lpp: variants cannot be overridden"},
        FaultyOverride{"variants", "{}", "--set: variants: variants cannot be overridden"},
        FaultyOverride{"trace.photons", "[1", "--set: trace.photons: not valid YAML: end of sequence flow not found"},
        FaultyOverride{"trace.photons", "{a: 1, a: 2}", "--set: trace.photons.a: a key must not be given twice"},
        FaultyOverride{"trace.photons", "!!int 5",
                       "--set: trace.photons: tags are not allowed, got tag:yaml.org,2002:int"}));

TEST(FaultyOverridePaths, AreRefused) {
  for (const char* path : {"", ".", "a.", ".a", "a..b", "[0]", "a[", "a[]", "a[x]", "a[-1]", "a[0]b", "a]", "a[0",
                           "a[99999999]", "a.[0]"}) {
    const std::string shown_path = *path == '\0' ? "" : std::string(path) + ": ";
    EXPECT_THAT(applied({{path, "1", "--set"}}).second, ElementsAre("--set: " + shown_path + kNoPath)) << path;
  }
}

TEST(ConfigDocument, RangeFaultsOfAnOverrideNameItsOrigin) {
  const Reader read = [](const ConfigNode& root) {
    root.map("trace", "").count({"photons", "", 1, 1000, {}});
    root.map("backlight", "").mark_read();
  };
  EXPECT_THAT(faults_of(kRun, read, {{"trace.photons", "1e6", "--set"}}),
              ElementsAre("--set: trace.photons: must lie in [1, 1000], got 1e6"));
  EXPECT_THAT(faults_of(kRun, read, {{"trace.photns", "1e6", "--set"}}),
              ElementsAre("--set: trace.photns: unknown key, did you mean `photons`?"));
  EXPECT_THAT(faults_of(kRun, read, {{"trace.photons", "", "--photons"}}),
              ElementsAre("--photons: trace.photons: must be a whole number (20e6 is one too), got nothing"));
}

TEST(ConfigDocument, OverridesMayNotNestTooDeep) {
  std::string path = "a";
  for (int i = 0; i < 70; ++i) path += ".a";
  EXPECT_THAT(applied({{path, "1", "--set"}}).second, ElementsAre(HasSubstr("must not nest deeper than 64")));
  EXPECT_THAT(applied({{"a", std::string(100000, '['), "--set"}}).second,
              ElementsAre("--set: a: must not nest deeper than 64"));
}

TEST(ConfigDocument, NodesTakenBeforeAnOverrideStayUsable) {
  ConfigDocument document = ConfigDocument::parse(kRun, "run.yaml");
  const ConfigNode trace = document.root().map("trace", "");
  document.apply({"trace", "{photons: 7}", "--set"});
  EXPECT_EQ(trace.count({"photons", "", 1, 1000, {}}), 100);
  EXPECT_EQ(document.root().map("trace", "").count({"photons", "", 1, 1000, {}}), 7);
}

TEST(ConfigDocument, SurvivesBeingMoved) {
  ConfigDocument first = ConfigDocument::parse("a: 1", "run.yaml");
  const ConfigNode root = first.root();
  const ConfigDocument second = std::move(first);
  EXPECT_EQ(root.number({"a", "", Range::any(), {}}), 1);
  EXPECT_NO_THROW(second.finish());
  EXPECT_EQ(second.source_text(), "a: 1");
  EXPECT_EQ(second.name(), "run.yaml");
}

// ---------------------------------------------------------------- variants

constexpr const char* kVariants = R"(backlight: {films: [{kind: bef}, {kind: dbef}]}
variants:
  dbef: {}
  lpp:
    backlight.films[1]: {kind: lpp,
      axis_deg: 270}
    trace.seed: "7"
)";

Reader reads_films() {
  return [](const ConfigNode& root) {
    for (const ConfigNode& film : root.map("backlight", "").maps("films", "")) {
      film.choice({"kind", "", {"bef", "dbef", "lpp"}, {}});
      film.number({"axis_deg", "", Range{0, 180, false, true}, 0.0});
    }
    root.map("trace", "").integer({"seed", "", 0, 100, 1});
    root.map("variants", "").mark_read();
  };
}

TEST(ConfigDocument, VariantsAreNamedListsOfOverrides) {
  const ConfigDocument document = ConfigDocument::parse(kVariants, "run.yaml");
  const auto variants = document.variants();
  ASSERT_EQ(variants.size(), 2u);
  EXPECT_EQ(variants[0].first, "dbef");
  EXPECT_THAT(variants[0].second, IsEmpty());
  EXPECT_EQ(variants[1].first, "lpp");
  ASSERT_EQ(variants[1].second.size(), 2u);
  EXPECT_EQ(variants[1].second[0].path, "backlight.films[1]");
  EXPECT_EQ(variants[1].second[0].yaml, "{kind: lpp, axis_deg: 270}");
  EXPECT_EQ(variants[1].second[0].origin, "run.yaml:5:5");
  EXPECT_EQ(variants[1].second[1].yaml, "\"7\"");
  document.root().map("backlight", "").mark_read();
  EXPECT_NO_THROW(document.finish()) << "variants() marks its key as read";
}

TEST(ConfigDocument, FaultsInAVariantAreToldAtTheirPlaceInTheFile) {
  std::vector<Override> changes;
  {
    const ConfigDocument first = ConfigDocument::parse(kVariants, "run.yaml");
    changes = first.variants()[1].second;
  }
  EXPECT_THAT(faults_of(kVariants, reads_films(), changes),
              ElementsAre("run.yaml:6:17: backlight.films[1].axis_deg: must lie in [0, 180), got 270",
                          "run.yaml:7:17: trace.seed: must be a whole number without quotes, got \"7\""));
}

TEST(ConfigDocument, FaultsInAVariantsPathAreToldAtThePath) {
  const std::string text = "a: {b: [1]}\nvariants:\n  x: {'a.b[2]': 1, a..b: 2, variants.x: 3}\n";
  const auto changes = ConfigDocument::parse(text, "run.yaml").variants()[0].second;
  EXPECT_THAT(applied(changes, text).second,
              ElementsAre("run.yaml:3:7: a.b: holds 1 items, the index must lie in [0, 1], got 2",
                          std::string("run.yaml:3:20: a..b: ") + kNoPath,
                          "run.yaml:3:29: variants.x: variants cannot be overridden"));

  ConfigDocument document = ConfigDocument::parse(text, "run.yaml");
  document.apply(changes[0]);
  document.root().mark_read();
  try {
    document.finish();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.faults()[0].file, "run.yaml");
    EXPECT_EQ(error.faults()[0].line, 3);
    EXPECT_EQ(error.faults()[0].column, 7);
  }
}

Lines variant_faults(const std::string& text) {
  const ConfigDocument document = ConfigDocument::parse(text, "run.yaml");
  document.variants();
  try {
    document.finish();
  } catch (const ConfigError& error) {
    return lines_of(error);
  }
  return {};
}

TEST(ConfigDocument, VariantsAreChecked) {
  EXPECT_THAT(variant_faults("{}"), IsEmpty());
  EXPECT_THAT(variant_faults("variants: {a-b_1.2: {x: 1}}"), IsEmpty());
  EXPECT_THAT(variant_faults("variants: [a]"), ElementsAre("run.yaml:1:11: variants: must be a map, got a list"));
  EXPECT_THAT(variant_faults("variants: {a: 5}"),
              ElementsAre("run.yaml:1:15: variants.a: must be a map of key paths ({} for no change), got 5"));
  EXPECT_THAT(variant_faults("variants: {a: }"),
              ElementsAre("run.yaml:1:12: variants.a: must be a map of key paths ({} for no change), got nothing"));
  EXPECT_THAT(variant_faults("variants: {a: {}, a: {}}"),
              ElementsAre("run.yaml:1:19: variants.a: a key must not be given twice, first in line 1"));
  for (const char* name : {"../x", ".x", "a/b", "a b", "''", "\xc3\xbc"}) {
    EXPECT_THAT(variant_faults("variants: {" + std::string(name) + ": {}}"),
                ElementsAre(HasSubstr("a variant's name must be")))
        << name;
  }
}

}  // namespace
}  // namespace evenglow::core

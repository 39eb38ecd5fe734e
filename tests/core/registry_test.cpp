#include "core/config/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/config_reading.h"

namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const Registry<double>& films() {
  static const Registry<double> registry({
      {"bef", "prism sheet",
       [](const ConfigNode& node) {
         return node.number({"pitch_um", "pitch of the prisms", Range::positive(), 50.0});
       }},
      {"lpp", "absorbing polarizer",
       [](const ConfigNode& node) {
         return node.number({"transmittance", "", Range::closed(0, 1), {}});
       }},
  });
  return registry;
}

Reader reads_film(std::optional<double>& made, std::optional<std::string> fallback = {}) {
  return [&made, fallback](const ConfigNode& root) { made = films().make(root, fallback); };
}

TEST(Registry, MakesWhatTheKindNames) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{kind: bef, pitch_um: 24}", reads_film(made)), IsEmpty());
  EXPECT_EQ(made, 0.024);
  EXPECT_THAT(films().names(), ElementsAre("bef", "lpp"));
}

TEST(Registry, FallsBackOnAKind) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{pitch_um: 24}", reads_film(made, "bef")), IsEmpty());
  EXPECT_EQ(made, 0.024);
}

TEST(Registry, AnUnknownKindIsOneFault) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{kind: lbp, transmittance: 7, pitch: 3}", reads_film(made)),
              ElementsAre("run.yaml:1:8: kind: must be one of bef, lpp; got lbp, did you mean `lpp`?"));
  EXPECT_EQ(made, std::nullopt);
}

TEST(Registry, AnUnknownKindIsOneFaultEvenWithAFallback) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{kind: 7, transmittance: 7}", reads_film(made, "bef")),
              ElementsAre("run.yaml:1:8: kind: must be one of bef, lpp; got 7"));
}

TEST(Registry, AMissingKindIsOneFault) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{transmittance: 7}", reads_film(made)),
              ElementsAre("run.yaml:1:1: kind: must be given (which kind of part this is; one of bef, lpp)"));
}

TEST(Registry, KeysOfAnotherKindAreUnknown) {
  std::optional<double> made;
  EXPECT_THAT(faults_of("{kind: lpp, transmittance: 0.4, pitch_um: 24}", reads_film(made)),
              ElementsAre("run.yaml:1:33: pitch_um: unknown key, known here: kind, transmittance"));
}

TEST(Registry, ChoiceOfAKindAlsoEndsTheJudging) {
  EXPECT_THAT(faults_of("{kind: x, other: 1}",
                        [](const ConfigNode& root) {
                          EXPECT_EQ(root.choice({"kind", "", {"a", "b"}, {}}), "a");
                          root.number({"needed", "", Range::any(), {}});
                          root.fault("must be well");
                        }),
              ElementsAre("run.yaml:1:8: kind: must be one of a, b; got x"));
}

}  // namespace
}  // namespace evenglow::core

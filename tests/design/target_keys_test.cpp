#include "design/problem/target_keys.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/config_reading.h"
#include "tests/support/program.h"

namespace evenglow::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The spec of a map `design`, and its faults.
core::Lines faults(const std::string& design, DesignSpec* spec = nullptr) {
  return core::faults_of("design: " + design + "\n", [&](const core::ConfigNode& root) {
    const DesignSpec read = read_design(root.map("design", ""));
    if (spec != nullptr) *spec = read;
  });
}

TEST(DesignKeys, TargetIsAWordOrAMap) {
  DesignSpec spec;
  EXPECT_THAT(faults("{}", &spec), IsEmpty());
  EXPECT_EQ(spec.target.kind, "uniform");
  EXPECT_EQ(spec.updater, "auto");
  EXPECT_THAT(faults("{target: uniform}", &spec), IsEmpty());
  EXPECT_THAT(faults("{target: {kind: center_weighted, corner: 0.7}}", &spec), IsEmpty());
  EXPECT_EQ(spec.target.corner, 0.7);
  EXPECT_THAT(faults("{target: round}"), ElementsAre(HasSubstr("design.target: must be")));
  EXPECT_THAT(faults("{target: {kind: uniform, corner: 0.7}}"), ElementsAre(HasSubstr("corner")));
  EXPECT_THAT(faults("{target: {csv: nowhere.csv}}"), ElementsAre(HasSubstr("design.target.csv")));
}

TEST(DesignKeys, MapsComeFromFiles) {
  const tests::TempFolder folder;
  const auto path = [&](const std::string& name) { return (folder.path() / name).string(); };
  std::ofstream(path("map.csv")) << "1,2\n3,0\n";
  std::ofstream(path("dark.csv")) << "0,0\n";
  std::ofstream(path("density.csv")) << "# from a result\n0.1,0.2\n";
  DesignSpec spec;
  EXPECT_THAT(faults("{target: {csv: " + path("map.csv") + "}}", &spec), IsEmpty());
  EXPECT_EQ(spec.target.kind, "map");
  EXPECT_EQ(spec.target.map.values.size(), 4U);
  EXPECT_THAT(faults("{target: {csv: " + path("dark.csv") + "}}"), ElementsAre(HasSubstr("got a dark map")));
  EXPECT_THAT(faults("{start: {result: " + folder.path().string() + "}}", &spec), IsEmpty());
  EXPECT_EQ(spec.start.map.values, (std::vector<double>{0.1, 0.2}));
  EXPECT_THAT(faults("{start: {file: " + path("density.csv") + "}}", &spec), IsEmpty());
  EXPECT_EQ(spec.start.kind, "map");
  EXPECT_THAT(faults("{start: {result: " + path("nowhere") + "}}"), ElementsAre(HasSubstr("design.start.result")));
  EXPECT_THAT(faults("{start: {}}"), ElementsAre(HasSubstr("must name file or result")));
  EXPECT_THAT(faults("{mask: " + path("dark.csv") + "}"), ElementsAre(HasSubstr("design.mask: must leave")));
  EXPECT_THAT(faults("{density_files: {largest: " + path("density.csv") + "}}", &spec), IsEmpty());
  EXPECT_FALSE(spec.largest_map.empty());
}

TEST(DesignKeys, GoalsNeedTheirBounds) {
  DesignSpec spec;
  EXPECT_THAT(faults("{goal: max_efficiency, subject_to: {rms: 0.02}}", &spec), IsEmpty());
  EXPECT_EQ(spec.goal.rms, 0.02);
  EXPECT_THAT(faults("{goal: min_rms, subject_to: {efficiency: 0.6}}", &spec), IsEmpty());
  EXPECT_EQ(spec.goal.efficiency, 0.6);
  EXPECT_THAT(faults("{goal: max_efficiency}"), ElementsAre(HasSubstr("design.subject_to.rms")));
  EXPECT_THAT(
      faults("{subject_to: {rms: 0.02}}"),
      ElementsAre(HasSubstr("design.subject_to.rms: belongs to the goal max_efficiency, got it with goal even")));
  EXPECT_THAT(faults("{goal: max_efficiency, subject_to: {rms: 0.02, efficiency: 0.6}}"),
              ElementsAre(HasSubstr("design.subject_to.efficiency: belongs to the goal min_rms")));
  EXPECT_THAT(faults("{goal: min_rms, subject_to: {efficiency: 0.6}, level: 0.1}"),
              ElementsAre(HasSubstr("design.level: must be left out")));
}

TEST(DesignKeys, ColorMayBeABoundOfAnyGoal) {
  DesignSpec spec;
  EXPECT_THAT(faults("{}", &spec), IsEmpty());
  EXPECT_FALSE(spec.goal.color);
  EXPECT_THAT(faults("{subject_to: {color: 0.004}}", &spec), IsEmpty());
  EXPECT_EQ(spec.goal.color, 0.004);
  EXPECT_THAT(faults("{goal: max_efficiency, subject_to: {rms: 0.02, color: 0.003}}", &spec), IsEmpty());
  EXPECT_EQ(spec.goal.color, 0.003);
  EXPECT_THAT(faults("{subject_to: {color: 0}}"), ElementsAre(HasSubstr("design.subject_to.color")));
}

TEST(DesignKeys, LimitsAndUpdaters) {
  DesignSpec spec;
  EXPECT_THAT(faults("{updater: spline, spline: {coefficients: [5, 3], method: cobyla}, neighbor_ratio: 1.3, "
                     "symmetry: y, anderson_vectors: 4}",
                     &spec),
              IsEmpty());
  EXPECT_EQ(spec.spline.nx, 5);
  EXPECT_EQ(spec.neighbor_ratio, 1.3);
  EXPECT_EQ(spec.symmetry, "y");
  EXPECT_THAT(faults("{updater: newton}"), ElementsAre(HasSubstr("design.updater: must be")));
  EXPECT_THAT(faults("{neighbor_ratio: 1}"), ElementsAre(HasSubstr("design.neighbor_ratio")));
  EXPECT_THAT(faults("{spline: {coefficients: [1, 1]}}"), ElementsAre(HasSubstr("at least two in all")));
  EXPECT_THAT(faults("{pareto_levels: [0.05, 1.2]}"), ElementsAre(HasSubstr("design.pareto_levels")));
}

}  // namespace
}  // namespace evenglow::design

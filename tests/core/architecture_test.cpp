#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/include_rules.h"

namespace evenglow::tests {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The rules of this house. docs/architecture.md shows the same table; a test below keeps the two alike.
const HouseRules& house() {
  static const HouseRules kRules{
      .floors = {"core", "tracer", "design", "app"},
      .for_everyone = {"core/base"},
      .folders =
          {
              {"core/base", {}},
              {"core/config", {}},
              {"core/math", {}},
              {"core/light", {"core/math"}},
              {"core/montecarlo", {}},
              {"core/parallel", {"core/montecarlo"}},
              {"core/dots", {"core/config"}},

              {"tracer/geometry", {"core/math"}},
              {"tracer/optics", {"core/light", "core/math", "core/montecarlo"}},
              {"tracer/polarized_bsdf",
               {"tracer/optics", "core/config", "core/light", "core/math", "core/montecarlo/photon_rng.h"}},
              {"tracer/films",
               {"tracer/optics", "tracer/polarized_bsdf", "core/config", "core/light", "core/math",
                "core/montecarlo/photon_rng.h"}},
              {"tracer/microstructure",
               {"tracer/optics", "core/config", "core/dots", "core/light", "core/math",
                "core/montecarlo/photon_rng.h"}},
              {"tracer/sources",
               {"tracer/geometry/mesh.h", "tracer/optics", "core/config", "core/light", "core/math",
                "core/montecarlo"}},
              {"tracer/receivers",
               {"tracer/geometry/mesh.h", "tracer/optics", "core/config", "core/light", "core/math",
                "core/montecarlo"}},
              {"tracer/scene",
               {"tracer/geometry", "tracer/optics", "tracer/polarized_bsdf", "tracer/films", "tracer/microstructure",
                "tracer/sources", "tracer/receivers", "core/config", "core/dots", "core/light", "core/math"}},
              {"tracer/wavefront", {}},
              {"tracer/transport",
               {"tracer/scene", "tracer/geometry", "tracer/optics", "tracer/films", "tracer/microstructure",
                "tracer/sources", "tracer/receivers", "tracer/wavefront", "core/config", "core/light", "core/math",
                "core/montecarlo", "core/parallel"}},
              {"tracer/goniometer",
               {"tracer/films", "tracer/optics", "tracer/polarized_bsdf", "core/config", "core/light", "core/math",
                "core/montecarlo"}},

              {"design/problem",
               {"core/config", "core/light/color.h", "core/math", "core/montecarlo/estimate.h",
                "core/montecarlo/tally.h", "tracer/scene/density_field.h", "tracer/scene/density_file.h",
                "tracer/receivers/luminance_receiver.h"}},
              {"design/updaters",
               {"design/problem", "tracer/scene/refined_density.h", "tracer/transport/arrival_records.h", "core/config",
                "core/math", "core/montecarlo/estimate.h"}},
              {"design/report",
               {"design/problem", "core/config", "core/math", "core/montecarlo/estimate.h",
                "tracer/polarized_bsdf/hdf5_writer.h"}},
              {"design/dots",
               {"design/problem", "core/config", "core/dots", "core/math", "core/montecarlo/batches.h",
                "core/montecarlo/photon_rng.h"}},
              {"design/tolerance",
               {"design/problem", "design/dots", "tracer/scene/backlight_spec.h", "tracer/scene/density_file.h",
                "tracer/receivers/luminance_receiver.h", "core/config", "core/dots", "core/math", "core/montecarlo"}},
              {"design/engine",
               {"design/problem", "design/updaters", "design/report", "design/dots",
                "tracer/microstructure/dot_grid.h", "tracer/scene", "tracer/transport",
                "tracer/receivers", "core/config", "core/math", "core/montecarlo", "core/parallel"}},

              {"app",
               {"design", "tracer/goniometer", "tracer/polarized_bsdf", "tracer/scene", "tracer/transport",
                "tracer/films/bef.h", "core/config", "core/dots", "core/math", "core/montecarlo", "core/parallel"}},
          },
      .libraries =
          {
              {"yaml-cpp", {"yaml-cpp/"}, {"core/config/"}},
              {"TBB", {"tbb/", "oneapi/"}, {"core/montecarlo/batches.cpp"}},
              {"MPI", {"mpi.h"}, {"core/parallel/mpi_link.cpp"}},
              {"OpenSSL", {"openssl/"}, {"core/base/sha256.cpp"}},
              {"Random123", {"Random123/"}, {"core/montecarlo/"}},
              {"Embree", {"embree"}, {"tracer/geometry/ray_caster.cpp"}},
              {"Highway", {"hwy/"}, {"tracer/wavefront/"}},
              {"Ceres", {"ceres/", "glog/"}, {"design/updaters/coarse_newton_updater.cpp", "tracer/polarized_bsdf/"}},
              {"HDF5", {"hdf5.h", "H5"}, {"tracer/polarized_bsdf/hdf5_"}},
              {"NLopt",
               {"nlopt"},
               {"design/updaters/gradient_updater.cpp", "design/updaters/spline_updater.cpp",
                "design/engine/outer_design.cpp"}},
              {"cairo", {"cairo"}, {"design/report/", "core/config/png_picture.cpp"}},
              {"libtiff", {"tiff"}, {"core/config/tiff_picture.cpp"}},
              {"nlohmann-json", {"nlohmann/"}, {"design/report/", "design/engine/checkpoint.cpp", "app/"}},
              {"CLI11", {"CLI/"}, {"app/"}},
              {"spdlog", {"spdlog/"}, {"app/"}},
              {"Eigen", {"Eigen/"}, {}},
              {"fmt", {"fmt/"}, {}},
              {"POSIX", {"sys/", "link.h", "unistd.h", "fcntl.h", "signal.h", "sched.h", "ucontext.h"}, {}},
          },
  };
  return kRules;
}

std::filesystem::path root() {
  return EVENGLOW_SOURCE_DIR;
}

TEST(Architecture, EveryIncludeKeepsTheRules) {
  const SourceTree sources = read_sources(root(), house().floors);
  ASSERT_GT(sources.size(), 20u) << "the sources were not found below " << root();
  EXPECT_THAT(include_faults(sources, house()), IsEmpty());
}

TEST(Architecture, TableRunsDownAndInNoCircle) {
  EXPECT_THAT(table_faults(house()), IsEmpty());
}

/// Rows `| \`folder\` | \`entry\`, \`entry\` |` of docs/architecture.md, entries sorted.
std::map<std::string, std::vector<std::string>> documented_table() {
  static const std::regex kRow(R"(^\| `([a-z_/]+)` \|([^|]*)\|$)");
  static const std::regex kEntry("`([^`]+)`");
  std::map<std::string, std::vector<std::string>> table;
  std::ifstream text(root() / "docs/architecture.md");
  for (std::string line; std::getline(text, line);) {
    std::smatch row;
    if (!std::regex_match(line, row, kRow)) continue;
    const std::string entries = row[2];
    auto& list = table[row[1]];
    for (std::sregex_iterator it(entries.begin(), entries.end(), kEntry), end; it != end; ++it)
      list.push_back((*it)[1]);
    std::ranges::sort(list);
  }
  return table;
}

TEST(Architecture, TheDocumentShowsTheSameTable) {
  std::map<std::string, std::vector<std::string>> expected;
  for (const FolderRule& rule : house().folders) {
    expected[rule.folder] = rule.may_use;
    std::ranges::sort(expected[rule.folder]);
  }
  EXPECT_EQ(documented_table(), expected);
}

// ---- The checks themselves, on a small made-up house.

HouseRules small_house() {
  return {.floors = {"core", "tracer"},
          .for_everyone = {"core/base"},
          .folders = {{"core/base", {}},
                      {"core/light", {}},
                      {"core/montecarlo", {}},
                      {"core/parallel", {"core/montecarlo"}},
                      {"tracer/optics", {"core/light", "core/montecarlo/rng.h"}}},
          .libraries = {{"TBB", {"tbb/"}, {"core/montecarlo/batches.cpp"}}, {"Eigen", {"Eigen/"}, {}}}};
}

std::vector<std::string> faults_of(const std::string& path, const std::string& text) {
  return include_faults({{path, text}}, small_house());
}

TEST(IncludeRules, AcceptsWhatIsAllowed) {
  const SourceTree sources{
      {"core/light/stokes.h", "// Comment.\n\n#pragma once\n#include <vector>\n#include <Eigen/Core>\n"},
      {"core/montecarlo/batches.cpp", "#include <tbb/info.h>\n#include \"core/base/error.h\"\n"},
      {"tracer/optics/bsdf.h", "#pragma once\n#include \"core/light/stokes.h\"\n#include \"core/montecarlo/rng.h\"\n"},
      {"tracer/optics/bsdf.cpp", "#include \"tracer/optics/bsdf.h\"\n\n#include <cmath>\n"}};
  EXPECT_THAT(include_faults(sources, small_house()), IsEmpty());
}

TEST(IncludeRules, FindsAnArrowThatRunsUp) {
  EXPECT_THAT(faults_of("core/light/a.cpp", "\n#include \"tracer/optics/bsdf.h\"\n"),
              ElementsAre("core/light/a.cpp:2: tracer/optics/bsdf.h: an arrow that runs up"));
}

TEST(IncludeRules, FindsAFolderOutsideTheTable) {
  EXPECT_THAT(faults_of("core/light/a.cpp", "#include \"core/montecarlo/rng.h\"\n"),
              ElementsAre(HasSubstr("core/light may not use it")));
  EXPECT_THAT(faults_of("core/shed/a.cpp", "#include \"core/light/stokes.h\"\n"),
              ElementsAre(HasSubstr("the folder is not in the table")));
}

TEST(IncludeRules, AnEntryWithItsEndingIsThatHeaderAlone) {
  EXPECT_THAT(faults_of("tracer/optics/a.cpp", "#include \"core/montecarlo/tally.h\"\n"),
              ElementsAre(HasSubstr("tracer/optics may not use it")));
}

TEST(IncludeRules, AFolderIsNotTheBeginningOfAnothersName) {
  EXPECT_THAT(faults_of("tracer/optics/a.cpp", "#include \"core/lighthouse/lamp.h\"\n"),
              ElementsAre(HasSubstr("tracer/optics may not use it")));
}

TEST(IncludeRules, FindsIncludesThatDoNotStartAtTheRoot) {
  EXPECT_THAT(faults_of("core/light/a.cpp", "#include \"stokes.h\"\n"), ElementsAre(HasSubstr("starts at the root")));
}

TEST(IncludeRules, FindsLibrariesOutsideTheirDoorOrWithout) {
  EXPECT_THAT(faults_of("core/light/a.cpp", "  #  include <tbb/info.h>  // fast\n#include <boost/any.hpp>\n"),
              ElementsAre(AllOf(HasSubstr("a.cpp:1:"), HasSubstr("TBB outside its door")),
                          AllOf(HasSubstr("a.cpp:2:"), HasSubstr("a library without a door"))));
}

TEST(IncludeRules, FindsAWrongHead) {
  EXPECT_THAT(faults_of("core/light/a.h", "#include <vector>\n#pragma once\n"), ElementsAre(HasSubstr("#pragma once")));
  EXPECT_THAT(faults_of("core/light/a-inl.h", "#include <vector>\n"), IsEmpty());
  EXPECT_THAT(include_faults({{"core/light/a.h", "#pragma once\n"},
                              {"core/light/a.cpp", "#include <vector>\n#include \"core/light/a.h\"\n"}},
                             small_house()),
              ElementsAre(HasSubstr("own header")));
}

TEST(IncludeRules, FindsFaultsOfTheTable) {
  HouseRules rules = small_house();
  rules.folders = {{"core/base", {}}, {"core/light", {"tracer/optics"}}};
  EXPECT_THAT(table_faults(rules), ElementsAre(HasSubstr("runs up")));
  rules.folders = {{"core/light", {"core/math"}}, {"core/math", {"core/light"}}};
  EXPECT_THAT(table_faults(rules), ElementsAre(HasSubstr("circle")));
}

}  // namespace
}  // namespace evenglow::tests

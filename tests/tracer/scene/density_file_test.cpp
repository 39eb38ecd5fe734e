#include "tracer/scene/density_file.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

std::filesystem::path file_with(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) / "evenglow_density_file_test.csv";
  std::ofstream(path) << text;
  return path;
}

TEST(DensityFile, ReadsRowsFromTheLowestY) {
  const core::NumberMatrix matrix = read_density_file(file_with("# density\n0.1,0.2,0.3\n0.4, 0.5 ,1\n\n"));
  EXPECT_EQ(matrix.nx, 3);
  EXPECT_EQ(matrix.ny, 2);
  EXPECT_EQ(matrix.values, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 1.0}));
}

TEST(DensityFile, NamesLineAndColumnOfAFault) {
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, std::string>>{{"0.1,0.2\n0.1\n", ":2: must have 2 entries"},
                                                        {"0.1,x\n", ":1:5: must be a density in [0, 1], got x"},
                                                        {"# c\n0.1,1.5\n", ":2:5: must be a density"},
                                                        {"0.1,nan\n", "must be a density"},
                                                        {"0.1,-0.2\n", "must be a density"},
                                                        {"0.1,\n", "must be a density"},
                                                        {"# only a comment\n", "must hold a matrix"},
                                                        {"", "must hold a matrix"}}) {
    try {
      read_density_file(file_with(text));
      ADD_FAILURE() << "accepted: " << text;
    } catch (const core::ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_density_file("/nonexistent/density.csv"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tracer

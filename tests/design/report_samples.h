#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "design/report/report.h"

/// Small reports with plausible values and a folder to write them to.
namespace evenglow::design::samples {

inline core::CellField ramp(int nx, int ny, double base) {
  core::CellField field({nx, ny, 0.0, 0.0, 12.0 / nx, 6.0 / ny}, 0.0);
  for (std::size_t i = 0; i < field.values.size(); ++i)
    field.values[i] = base * (1.0 + 0.1 * static_cast<double>(i)) / 3;
  return field;
}

inline Report report(const std::string& variant = "") {
  Report r;
  r.version = "0.1.0";
  r.title = "sample";
  r.variant = variant;
  r.command = "evenglow design run.yaml";
  r.run_file_text = "evenglow: 1\n";
  r.run_file_sha256 = "ab12";
  r.overrides = {"trace.seed=7"};
  r.seed = 7;
  r.threads = 4;
  r.stop_reason = "the steps are used up";
  r.luminance_estimator = "cone of 10 degrees";
  for (int i = 0; i < 3; ++i) {
    r.steps.push_back({i, 1000000, 0.3 / (i + 1), {0.29 / (i + 1), 0.001}, {0.5, 0.002}, 0.1, 900.0 + i, 2.5, 1.25});
  }
  r.final = {2000000, 0.11, {0.1, 0.001}, 0.9, 0.8, {1000.0, 3.0}, 1010.0, {0.5, 0.001}};
  r.start_luminance = ramp(6, 4, 800.0);
  r.luminance = ramp(6, 4, 1000.0);
  r.luminance_se = ramp(6, 4, 10.0);
  r.density = ramp(8, 4, 0.1);
  r.energy.emitted_lm = 100.0;
  for (const char* side : {"left", "right", "front", "back", "bottom"})
    r.energy.escaped.push_back({side, {0.02, 1e-4}});
  r.energy.escaped.push_back({"top", {0.5, 0.001}});
  r.energy.absorbed = {{"plate", {0.1, 5e-4}}, {"white sheet", {0.25, 5e-4}}};
  r.energy.lost = {0.05, 1e-4};
  r.angular = AngularLuminance{{0, 30, 60, 90}, 4, std::vector<core::Estimate>(12, {500.0, 5.0})};
  r.notes = {"the upper limit of the density binds"};
  r.timing = {3.75, 7.5, 4e5};
  return r;
}

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An empty folder that goes with the test.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("evenglow_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace evenglow::design::samples

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace evenglow::app {

/// What the user typed after a command.
struct Options {
  std::vector<std::filesystem::path> files;  ///< run files
  std::filesystem::path out;                 ///< empty: out/<name of the file>
  std::vector<std::string> set;              ///< key=value
  std::optional<std::string> seed;           ///< as typed
  std::optional<std::string> photons;        ///< as typed (20e6)
  int threads = 0;                           ///< 0: all
  bool quiet = false;
  bool overwrite = false;
  bool resume = false;
};

/// Exit codes of the program.
enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

}  // namespace evenglow::app

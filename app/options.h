#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace evenglow::core {
class RankGroup;
}

namespace evenglow::app {

/// What the user typed after a command, and who shares it.
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
  bool simulate = false;             ///< a batch of single traces
  bool json_progress = false;        ///< progress as lines of JSON, for programs
  bool reference = false;            ///< the keys as tables in Markdown
  std::uint64_t photon = 0;          ///< index of the photon to follow
  std::uint32_t step = 0;            ///< of the trace that it belongs to
  std::uint32_t stream = 0;          ///< number of the variant that it belongs to
  std::filesystem::path state;       ///< checkpoint whose density the photon meets; empty: the density of the run file
  std::filesystem::path design;      ///< result whose density a tolerance run makes; empty: as the run file says
  std::optional<int> sample;         ///< the one to replay, from 1; 0: the nominal design
  int path_count = 12;               ///< ways to draw
  std::vector<double> window;        ///< mm along x that are drawn, from and to
  core::RankGroup* ranks = nullptr;  ///< that share the run (rank_role.h); null: this process alone
  bool helper = false;               ///< a rank that writes no results
};

/// Exit codes of the program.
enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130 };

}  // namespace evenglow::app

#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>

#include "app/options.h"
#include "core/parallel/ranks.h"

/// What a process does in a run that several share. All run the same commands on the same input. Rank 0 writes the
/// results and tells of progress. The others are helpers: they say nothing, and what the command keeps on disk (the
/// state of a design) they keep in a folder of their own below the temporary one, which goes with them. To resume, they
/// are given the state of rank 0, so that all go on from the same step.
namespace evenglow::app {

/// From here on stdout and stderr of this process go nowhere.
void keep_quiet();

class RankRole {
 public:
  /// `directory`: where rank 0 puts the results. Throws Error if the temporary folder refuses.
  RankRole(core::RankGroup& ranks, const Options& options, const std::filesystem::path& directory,
           const std::stop_token& stop);
  ~RankRole();
  RankRole(const RankRole&) = delete;
  RankRole& operator=(const RankRole&) = delete;

  /// Those of this rank.
  const Options& options() const { return options_; }

 private:
  Options options_;
  std::filesystem::path own_folder_;  ///< of a helper
};

/// The states of interrupted work in a directory and the folders in it (checkpoints and `batch.json`; no links, 1 GiB
/// at most) as one text, and back into another one, which nothing leaves. Throw Error. Exposed for their test.
std::string packed_state(const std::filesystem::path& directory);
void unpack_state(const std::string& bytes, const std::filesystem::path& directory);

}  // namespace evenglow::app

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/error.h"

/// Messages between the processes of one run ("ranks", as MPI calls them). Calls come from one thread at a time.
namespace evenglow::core {

/// A few numbers from another rank.
struct RankMessage {
  int from = 0;
  std::vector<std::uint64_t> words;
};

/// Another rank has ended, or hangs: nothing can be agreed with it any more.
class RankLost : public Error {
 public:
  using Error::Error;
};

class RankLink {
 public:
  virtual ~RankLink() = default;
  virtual int rank() const = 0;   ///< from 0
  virtual int count() const = 0;  ///< at least 1

  /// Every rank gives bytes, every rank gets those of all in their order. Waits for the slowest; if a stop is asked for
  /// here meanwhile and the others do not come within the patience (rank 0: 0.6 s, since `mpirun` kills after 1 s;
  /// others: 20 s), throws RankLost.
  virtual std::vector<std::string> all_gather(const std::string& mine, const std::stop_token& stop) = 0;
  /// At most `kMostWords` numbers; returns at once.
  virtual void send(int to, const std::vector<std::uint64_t>& words) = 0;
  /// A message that has come, in the order of sending as far as one sender goes; returns at once.
  virtual std::optional<RankMessage> poll() = 0;
  /// Ends this process at once: another rank does not answer any more, and MPI has no other way out.
  virtual void abandon(int exit_code) = 0;

  static constexpr std::size_t kMostWords = 4096;
};

/// The ranks that `mpirun`, `srun` and their like have started; null if this process was started alone. One at a time,
/// made and destroyed by the main thread. Throws Error if there are others and this program was built without MPI.
std::unique_ptr<RankLink> world_link();

}  // namespace evenglow::core

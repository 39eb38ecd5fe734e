#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <stop_token>
#include <vector>

#include "core/parallel/rank_link.h"

namespace evenglow::core {

/// What became of the batches at this rank.
struct HandedOut {
  std::vector<std::size_t> made;  ///< in rising order
  bool stopped = false;           ///< here or elsewhere
  std::exception_ptr failure;     ///< thrown by the work here
};

/// Divides `count` batches among the ranks: rank 0 gives their numbers to its own threads and to the ranks that ask.
/// Each asks for as many as it has threads and one beyond, and for one more whenever one is begun, so that nobody waits
/// for an answer. A failure or stop anywhere ends it everywhere.
HandedOut hand_out(RankLink& link, std::size_t count, int threads,
                   const std::function<void(std::size_t, const std::stop_token&)>& work, const std::stop_token& stop);

}  // namespace evenglow::core

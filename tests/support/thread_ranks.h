#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/parallel/rank_link.h"

namespace evenglow::tests {

/// Links among `count` ranks that are threads of this process, for tests without MPI. They live on their own.
std::vector<std::unique_ptr<core::RankLink>> thread_links(int count);

/// Runs `body(rank, link)` for each of `count` ranks on a thread of its own, and waits for all.
void on_ranks(int count, const std::function<void(int rank, std::unique_ptr<core::RankLink> link)>& body);

}  // namespace evenglow::tests

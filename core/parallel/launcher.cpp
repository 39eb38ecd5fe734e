#include "core/parallel/launcher.h"

#include <cstdlib>

namespace evenglow::core {
namespace {

/// Open MPI; MPICH and Intel MPI; a step of Slurm with PMI or PMIx.
constexpr const char* kSizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
constexpr const char* kMarks[] = {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"};

}  // namespace

bool started_by_launcher() {
  for (const char* name : kMarks) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

int launched_ranks() {
  if (!started_by_launcher()) return 1;
  for (const char* name : kSizes) {
    const char* text = std::getenv(name);
    if (text != nullptr && std::atoi(text) > 0) return std::atoi(text);
  }
  return 1;
}

}  // namespace evenglow::core

#include "core/base/error.h"
#include "core/parallel/launcher.h"
#include "core/parallel/rank_link.h"

namespace evenglow::core {

std::unique_ptr<RankLink> world_link() {
  if (launched_ranks() > 1) {
    throw Error("started as several processes, but this program was built without MPI (-DEVENGLOW_MPI=ON)");
  }
  return nullptr;
}

}  // namespace evenglow::core

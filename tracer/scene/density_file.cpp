#include "tracer/scene/density_file.h"

#include <fmt/core.h>

#include "core/base/error.h"

namespace evenglow::tracer {

core::NumberMatrix read_density_file(const std::filesystem::path& file) {
  if (!core::is_picture(file)) return core::read_matrix_csv(file, {0.0, 1.0, "a density in [0, 1]"});
  constexpr std::size_t kMostCells = 1000000;
  core::NumberMatrix picture = core::read_picture(file);
  if (picture.values.size() > kMostCells) {
    throw core::ConfigError(core::Fault{file.string(), 0, 0, "",
                                        fmt::format("must not hold more than {} cells, got {} x {}", kMostCells,
                                                    picture.nx, picture.ny)});
  }
  return picture;
}

}  // namespace evenglow::tracer

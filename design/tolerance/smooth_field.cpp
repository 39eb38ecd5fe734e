#include "design/tolerance/smooth_field.h"

#include <cmath>
#include <numbers>

#include "design/tolerance/distribution.h"

namespace evenglow::design {

core::CellField smooth_field(const core::CellGrid& grid, double length, core::PhotonRng& rng) {
  constexpr int kWaves = 64;
  const double amplitude = std::sqrt(2.0 / kWaves);
  core::CellField field(grid, 0.0);
  for (int wave = 0; wave < kWaves; ++wave) {
    const double kx = draw_normal(rng) / length, ky = draw_normal(rng) / length;
    const double phase = 2.0 * std::numbers::pi * rng.uniform();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const int ix = static_cast<int>(i) % grid.nx, iy = static_cast<int>(i) / grid.nx;
      field.values[i] += amplitude * std::cos(kx * grid.center_x(ix) + ky * grid.center_y(iy) + phase);
    }
  }
  return field;
}

}  // namespace evenglow::design

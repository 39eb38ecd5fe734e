#include "design/engine/four_stream.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace evenglow::design {
namespace {

constexpr double kDamping = 0.5;      // of the ratio updates: the streams lag behind the density
constexpr double kMostChange = 1.5;   // of a density in a sweep
constexpr double kMostMixing = 0.25;  // share that goes to each neighbor in a step

/// Streams and what the pattern has thrown back into them; a sweep takes them through the plate once.
class Streams {
 public:
  explicit Streams(const StreamPlate& plate)
      : plate_(plate), nx_(plate.cells.nx), ny_(plate.cells.ny), scattered_(plate.cells.size(), 0.0) {
    for (std::size_t side = 0; side < 4; ++side) arriving_[side].assign(static_cast<std::size_t>(lines(side)), 0.0);
  }

  /// Flux that leaves each cell.
  std::vector<double> sweep(const std::vector<double>& density) {
    std::vector<double> met(density.size(), 0.0);
    std::array<std::vector<double>, 4> arrived = arriving_;
    for (std::size_t from = 0; from < 4; ++from) {
      const std::size_t to = from ^ 1U;
      std::vector<double> phi = entering(from);
      const int steps = lines(from) == ny_ ? nx_ : ny_;
      const bool rising = from % 2 == 0;
      for (int i = 0; i < steps; ++i) cross(from, rising ? i : steps - 1 - i, density, phi, met);
      arrived[to] = std::move(phi);
    }
    arriving_ = std::move(arrived);
    for (std::size_t i = 0; i < met.size(); ++i) {
      scattered_[i] = (1.0 - plate_.out) * met[i] + plate_.inside;
      met[i] *= plate_.out;
    }
    return met;
  }

 private:
  int lines(std::size_t side) const { return side < 2 ? ny_ : nx_; }

  std::vector<double> entering(std::size_t side) const {
    std::vector<double> phi = arriving_[side];
    for (double& value : phi) value *= plate_.edges[side].reflectance;
    for (std::size_t i = 0; i < plate_.edges[side].inflow.size(); ++i) phi[i] += plate_.edges[side].inflow[i];
    return phi;
  }

  /// The stream from `side` through row or column `at`.
  void cross(std::size_t side, int at, const std::vector<double>& density, std::vector<double>& phi,
             std::vector<double>& met) const {
    const bool along_x = side < 2;
    const double step = along_x ? plate_.cells.dx : plate_.cells.dy;
    for (std::size_t line = 0; line < phi.size(); ++line) {
      const std::size_t ix = along_x ? static_cast<std::size_t>(at) : line;
      const std::size_t i = (along_x ? line : static_cast<std::size_t>(at)) * static_cast<std::size_t>(nx_) + ix;
      phi[line] += 0.25 * scattered_[i];
      const double lost = phi[line] * -std::expm1(-plate_.rate[ix] * density[i] * step);
      phi[line] -= lost;
      met[i] += lost;
    }
    mix(phi, step, along_x ? plate_.cells.dy : plate_.cells.dx);
  }

  /// A random walk sideways; the borders reflect.
  void mix(std::vector<double>& phi, double step, double width) const {
    const double share = std::min(kMostMixing, 0.5 * plate_.spread * step / (width * width));
    double before = phi.front();
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const double here = phi[i];
      const double after = i + 1 < phi.size() ? phi[i + 1] : here;
      phi[i] = here + share * (before + after - 2.0 * here);
      before = here;
    }
  }

  const StreamPlate& plate_;
  int nx_, ny_;
  std::vector<double> scattered_;
  std::array<std::vector<double>, 4> arriving_;  ///< at each side, from within
};

}  // namespace

core::CellField stream_light(const StreamPlate& plate, const core::CellField& density, int sweeps) {
  Streams streams(plate);
  core::CellField light(plate.cells, 0.0);
  for (int i = 0; i < sweeps; ++i) light.values = streams.sweep(density.values);
  return light;
}

core::CellField stream_density(const StreamPlate& plate, const core::CellField& target, double level, double least,
                               double largest, int sweeps) {
  Streams streams(plate);
  core::CellField density(plate.cells, level);
  const double wanted = target.mean();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<double> light = streams.sweep(density.values);
    const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
    if (!(mean > 0.0)) continue;
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double ratio = target.values[i] / wanted / std::max(light[i] / mean, 1e-6);
      density.values[i] *= std::clamp(std::pow(ratio, kDamping), 1.0 / kMostChange, kMostChange);
    }
    const double scale = level / density.mean();
    for (double& value : density.values) value = std::clamp(value * scale, least, largest);
  }
  return density;
}

}  // namespace evenglow::design

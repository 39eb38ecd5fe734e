#include "design/dots/process.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/montecarlo/batches.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kChunk = 8192;
constexpr double kLeastRadius = 1e-5;  // mm

/// Two independent normal numbers (Box & Muller, Ann. Math. Stat. 29, 1958).
struct NormalPair {
  double first, second;

  explicit NormalPair(core::PhotonRng& rng) {
    const double radius = std::sqrt(-2.0 * std::log(rng.uniform())), turn = 2.0 * std::numbers::pi * rng.uniform();
    first = radius * std::cos(turn);
    second = radius * std::sin(turn);
  }
};

}  // namespace

core::DotPattern processed(const core::DotPattern& dots, const ProcessSpread& process, std::uint64_t seed,
                           int threads) {
  core::DotPattern made = dots;
  core::run_batches((dots.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t end = std::min(dots.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i) {
      core::PhotonRng rng({seed, 2, 1}, i);
      const NormalPair place(rng), size(rng);
      made[i].x += process.position_spread * place.first;
      made[i].y += process.position_spread * place.second;
      made[i].radius += static_cast<float>(0.5 * (process.bias + process.size_spread * size.first));
    }
  });
  std::erase_if(made, [](const core::Dot& dot) { return dot.radius < kLeastRadius; });
  return made;
}

}  // namespace evenglow::design

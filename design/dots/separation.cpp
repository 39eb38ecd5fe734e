#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/montecarlo/photon_rng.h"
#include "design/dots/cell_corner.h"
#include "design/dots/dot_moves.h"
#include "design/dots/relaxation.h"
#include "design/dots/start_dots.h"

namespace evenglow::design {
namespace {

constexpr int kPlacesTried = 400;
constexpr double kAway = 1e6;        // mm
constexpr double kOvershoot = 1e-5;  // mm: ends the creep towards the exact distance

float widest_dot(const DotStore& store) {
  return store.size() == 0 ? 0.0f : *std::max_element(store.dots().diameter.begin(), store.dots().diameter.end());
}

/// Whether a dot of this diameter at the place is too near to a dot other than `self`.
bool conflicts(const DotSpec& spec, const DotStore& store, std::size_t self, double x, double y, float diameter,
               double reach) {
  const auto& dots = store.dots();
  bool found = false;
  store.near(x, y, reach, [&](std::size_t j) {
    if (found || j == self) return;
    const double least = least_distance(spec, diameter, dots.diameter[j]);
    const double dx = x - dots.x[j], dy = y - dots.y[j];
    found = dx * dx + dy * dy < least * least;
  });
  return found;
}

}  // namespace

bool separate(const DotSpec& spec, const CoverageMap& map, int max_steps, int threads, DotStore& store,
              const std::stop_token& stop) {
  auto& dots = store.dots();
  DotMoves moves(store.size());
  const float widest = widest_dot(store);
  for (int step = 0; step < max_steps && !stop.stop_requested(); ++step) {
    std::atomic<bool> clean = true;
    for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
      for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
        const double x = dots.x[i], y = dots.y[i];
        double push_x = 0.0, push_y = 0.0;
        store.near(x, y, least_distance(spec, dots.diameter[i], widest), [&](std::size_t j) {
          const double least = least_distance(spec, dots.diameter[i], dots.diameter[j]);
          double dx = x - dots.x[j], dy = y - dots.y[j];
          double r2 = dx * dx + dy * dy;
          if (j == i || r2 >= least * least) return;
          if (r2 == 0.0) {  // no direction of its own: the two take opposite ones
            dx = i < j ? 1e-6 : -1e-6;
            dy = 0.5 * dx;
            r2 = dx * dx + dy * dy;
          }
          const double r = std::sqrt(r2);
          const double share = (0.5 * (least - r) + kOvershoot) / r;
          push_x += share * dx;
          push_y += share * dy;
          clean.store(false, std::memory_order_relaxed);
        });
        moves.x[i] = x;
        moves.y[i] = y;
        if (push_x != 0.0 || push_y != 0.0)
          move_within(spec, map, cell, push_x, push_y, dots.diameter[i], moves.x[i], moves.y[i]);
      }
    });
    if (clean) return true;
    for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
      std::copy(moves.x.begin() + static_cast<std::ptrdiff_t>(store.begin(cell)),
                moves.x.begin() + static_cast<std::ptrdiff_t>(store.end(cell)),
                dots.x.begin() + static_cast<std::ptrdiff_t>(store.begin(cell)));
      std::copy(moves.y.begin() + static_cast<std::ptrdiff_t>(store.begin(cell)),
                moves.y.begin() + static_cast<std::ptrdiff_t>(store.end(cell)),
                dots.y.begin() + static_cast<std::ptrdiff_t>(store.begin(cell)));
      store.sort(cell);
    });
  }
  return false;
}

std::size_t settle_conflicts(const DotSpec& spec, const CoverageMap& map, DotStore& store,
                             const std::stop_token& stop) {
  auto& dots = store.dots();
  const core::CellGrid& g = map.grid();
  const float widest = widest_dot(store);
  for (std::size_t cell = 0; cell < store.cell_count() && !stop.stop_requested(); ++cell) {
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
      const double reach = least_distance(spec, dots.diameter[i], widest);
      if (!conflicts(spec, store, i, dots.x[i], dots.y[i], dots.diameter[i], reach)) continue;
      core::PhotonRng rng({spec.seed, 1, 1}, i);
      const double half = 0.5 * core::footprint_span(spec.footprint, dots.diameter[i]);
      const CellCorner corner = cell_corner(g, cell);
      bool placed = false;
      for (int k = 0; k < kPlacesTried && !placed; ++k) {
        const double x = corner.x + rng.uniform() * g.dx;
        const double y = corner.y + rng.uniform() * g.dy;
        if (map.free().clearance(x, y, 2.0 * half) < half) continue;
        if (conflicts(spec, store, i, x, y, dots.diameter[i], reach)) continue;
        dots.x[i] = x;
        dots.y[i] = y;
        placed = true;
      }
      if (!placed) {
        dots.x[i] = g.x0 - kAway;  // in the way of no other one until it is removed
      } else {
        store.sort(cell);
        i = store.begin(cell) - 1;  // the order has changed
      }
    }
  }
  std::vector<char> removed(store.size(), 0);
  for (std::size_t i = 0; i < store.size(); ++i) removed[i] = dots.x[i] <= g.x0 - kAway ? 1 : 0;
  const auto count = static_cast<std::size_t>(std::count(removed.begin(), removed.end(), 1));
  if (count > 0) store.remove(removed);
  return count;
}

}  // namespace evenglow::design

#include "design/dots/relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "design/dots/count_restoring.h"
#include "design/dots/dot_moves.h"
#include "design/dots/start_dots.h"

namespace evenglow::design {
namespace {

constexpr double kWiden = 1.25;       // spacings of neighbors differ by so much at most
constexpr double kLongestStep = 0.3;  // in spacings
constexpr double kTiny = 1e-12;       // mm2
constexpr std::size_t kMostBorders = 8;

struct Push {
  double x = 0.0, y = 0.0;
};

/// What one dot at (dx, dy) from another one adds to the push on that.
void add_push(double dx, double dy, double s, double t, double reach_share, Push& push) {
  const double mean = std::min(0.5 * (s + t), kWiden * std::min(s, t));
  const double reach = reach_share * mean;
  const double r2 = dx * dx + dy * dy;
  if (r2 >= reach * reach || r2 < kTiny) return;
  const double r = std::sqrt(r2);
  const double force = mean * (1.0 - r / reach) * (1.0 - r / reach) / r;
  push.x += force * dx;
  push.y += force * dy;
}

/// The push of all dots near dot i, and of the images of these and of itself behind the borders near it, as if the
/// pattern went on there: so dots crowd no border.
Push push_on(const CoverageMap& map, const RelaxationSettings& settings, const DotStore& store, std::size_t i) {
  const auto& dots = store.dots();
  const double x = dots.x[i], y = dots.y[i], s = static_cast<double>(dots.spacing[i]);
  std::array<FreeArea::Border, kMostBorders> borders;
  std::size_t border_count = 0;
  map.free().borders_within(x, y, settings.reach * kWiden * s, [&](const FreeArea::Border& border) {
    if (border_count < kMostBorders) borders[border_count++] = border;
  });
  Push push;
  store.near(x, y, settings.reach * kWiden * s, [&](std::size_t j) {
    const double dx = x - dots.x[j], dy = y - dots.y[j], t = static_cast<double>(dots.spacing[j]);
    add_push(dx, dy, s, t, settings.reach, push);
    for (std::size_t b = 0; b < border_count; ++b) {
      const FreeArea::Border& border = borders[b];
      const double behind = 2.0 * (border.distance - dx * border.nx - dy * border.ny);  // of the image, from dot j
      if (behind > 0.0) add_push(dx + behind * border.nx, dy + behind * border.ny, s, t, settings.reach, push);
    }
  });
  const double length = settings.pace * std::hypot(push.x, push.y);
  const double part = length > kLongestStep * s ? kLongestStep * s / length : 1.0;
  return {push.x * settings.pace * part, push.y * settings.pace * part};
}

}  // namespace

void relax(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law, const RelaxationSettings& settings,
           int threads, DotStore& store, const std::stop_token& stop) {
  DotMoves moves(store.size());
  auto& dots = store.dots();
  const core::CellField wanted = wanted_counts(map, law);
  const auto step = [&](bool bound) {
    for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
      for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
        const Push push = push_on(map, settings, store, i);
        moves.x[i] = dots.x[i];
        moves.y[i] = dots.y[i];
        if (bound) {
          move_within(spec, map, cell, push.x, push.y, dots.diameter[i], moves.x[i], moves.y[i]);
        } else {
          move_free(spec, map, push.x, push.y, dots.diameter[i], moves.x[i], moves.y[i]);
        }
      }
    });
    for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
      for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
        dots.x[i] = moves.x[i];
        dots.y[i] = moves.y[i];
        dots.spacing[i] = static_cast<float>(law.spacing(map.at(dots.x[i], dots.y[i])));
      }
      if (bound) store.sort(cell);
    });
    if (!bound) store.sort_all(threads);
  };
  for (int i = 0; i < settings.free_steps; ++i) {
    if (stop.stop_requested()) return;
    step(false);
    if ((i + 1) % settings.restore_every == 0 || i + 1 == settings.free_steps)
      restore_counts(spec, map, wanted, threads, store);
  }
  for (int i = 0; i < settings.bound_steps && !stop.stop_requested(); ++i) step(true);
}

}  // namespace evenglow::design

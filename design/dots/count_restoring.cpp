#include "design/dots/count_restoring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/cell_index.h"

namespace evenglow::design {
namespace {

constexpr double kBeyond = 0.05;  // least way behind the border, in spacings
constexpr std::size_t kMostVisited = 20000;
constexpr double kWhole = 1e-6;  // nearer to a whole number than this is whole

/// The four cells around a cell.
struct Way {
  int dx, dy;
};
constexpr std::array<Way, 4> kWays = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

class Restoring {
 public:
  Restoring(const DotSpec& spec, const CoverageMap& map, const core::CellField& wanted, DotStore& store)
      : spec_(spec),
        map_(map),
        wanted_(wanted.values),
        store_(store),
        members_(wanted_.size()),
        came_(wanted_.size(), 0) {
    for (std::size_t cell = 0; cell < members_.size(); ++cell) {
      for (std::size_t i = store.begin(cell); i < store.end(cell); ++i)
        members_[cell].push_back(static_cast<std::uint32_t>(i));
    }
  }

  void run() {
    for (std::size_t cell = 0; cell < members_.size(); ++cell) {
      while (room(cell) < 0 && reach_out(cell, true)) {
      }
      while (spare(cell) < 0 && reach_out(cell, false)) {
      }
    }
  }

 private:
  std::size_t neighbor(std::size_t cell, const Way& way) const {
    const core::CellGrid& g = store_.grid();
    const int ix = static_cast<int>(cell) % g.nx + way.dx, iy = static_cast<int>(cell) / g.nx + way.dy;
    if (ix < 0 || ix >= g.nx || iy < 0 || iy >= g.ny) return cell;
    return core::cell_index(g.nx, ix, iy);
  }

  /// How many more, or fewer, the cell may have; negative: it has too many, or too few.
  int room(std::size_t cell) const {
    return static_cast<int>(std::ceil(wanted_[cell] - kWhole)) - static_cast<int>(members_[cell].size());
  }
  int spare(std::size_t cell) const {
    return static_cast<int>(members_[cell].size()) - static_cast<int>(std::floor(wanted_[cell] + kWhole));
  }

  /// Breadth first from the cell to the nearest one with room (`giving`) or one to spare, then passes one dot along.
  bool reach_out(std::size_t start, bool giving) {
    ++mark_;
    queue_.assign(1, start);
    from_.assign(1, 0);
    came_[start] = mark_;
    for (std::size_t at = 0; at < queue_.size() && queue_.size() < kMostVisited; ++at) {
      const std::size_t cell = queue_[at];
      if (at > 0 && (giving ? room(cell) : spare(cell)) > 0) return pass_along(at, giving);
      for (const Way& way : kWays) {
        const std::size_t next = neighbor(cell, way);
        if (came_[next] == mark_ || map_.free_share(next) <= 0.0) continue;
        came_[next] = mark_;
        queue_.push_back(next);
        from_.push_back(at);
      }
    }
    return false;
  }

  bool pass_along(std::size_t at, bool giving) {
    for (; at != 0; at = from_[at]) {
      const std::size_t near = queue_[from_[at]], far = queue_[at];
      if (!(giving ? pass(near, far) : pass(far, near))) return false;
    }
    return true;
  }

  /// Moves the dot of `cell` that is nearest to the border with `next` behind it.
  bool pass(std::size_t cell, std::size_t next) {
    const core::CellGrid& g = store_.grid();
    const int ix = static_cast<int>(next) % g.nx, iy = static_cast<int>(next) / g.nx;
    const double low_x = g.x0 + ix * g.dx, low_y = g.y0 + iy * g.dy;
    auto& dots = store_.dots();
    std::size_t best = members_[cell].size();
    double best_way = 0.0, best_x = 0.0, best_y = 0.0;
    for (std::size_t k = 0; k < members_[cell].size(); ++k) {
      const std::size_t i = members_[cell][k];
      const double room = kBeyond * static_cast<double>(dots.spacing[i]);
      const auto behind = [&](double place, double low, double size) {
        const double most = std::min(room, 0.25 * size);
        return std::clamp(place, low + most, low + size - most);
      };
      const double x = ix == static_cast<int>(cell) % g.nx ? dots.x[i] : behind(dots.x[i], low_x, g.dx);
      const double y = iy == static_cast<int>(cell) / g.nx ? dots.y[i] : behind(dots.y[i], low_y, g.dy);
      const double way = std::abs(x - dots.x[i]) + std::abs(y - dots.y[i]);
      const double half = 0.5 * core::footprint_span(spec_.footprint, dots.diameter[i]);
      if ((best < members_[cell].size() && way >= best_way) || map_.free().clearance(x, y, 2.0 * half) < half) continue;
      best = k;
      best_way = way;
      best_x = x;
      best_y = y;
    }
    if (best == members_[cell].size()) return false;
    const std::uint32_t moved = members_[cell][best];
    dots.x[moved] = best_x;
    dots.y[moved] = best_y;
    members_[cell].erase(members_[cell].begin() + static_cast<std::ptrdiff_t>(best));
    members_[next].push_back(moved);
    return true;
  }

  const DotSpec& spec_;
  const CoverageMap& map_;
  const std::vector<double>& wanted_;
  DotStore& store_;
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<std::uint32_t> came_;
  std::uint32_t mark_ = 0;
  std::vector<std::size_t> queue_, from_;
};

}  // namespace

void restore_counts(const DotSpec& spec, const CoverageMap& map, const core::CellField& wanted, int threads,
                    DotStore& store) {
  Restoring(spec, map, wanted, store).run();
  store.sort_all(threads);
}

}  // namespace evenglow::design

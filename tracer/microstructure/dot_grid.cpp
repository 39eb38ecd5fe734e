#include "tracer/microstructure/dot_grid.h"

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

/// More entries than this for each dot: the bins are made larger, so that large dots do not fill the memory.
constexpr std::size_t kMostEntries = 4;
/// Points of a dot that tell how much of it lies in which cell.
constexpr int kCoveragePoints = 256;

core::Vec2 turned(const core::Vec2& v, const core::Vec2& axis) {
  return {axis.x() * v.x() - axis.y() * v.y(), axis.y() * v.x() + axis.x() * v.y()};
}

/// Does a line along an axis of one square part it from the other? Both by center offset and half width.
bool parted(const core::Vec2& offset, const core::Vec2& a, double ra, const core::Vec2& b, double rb) {
  const double cosine = std::abs(a.dot(b)), sine = std::abs(a.x() * b.y() - a.y() * b.x());
  const double reach = ra + rb * (cosine + sine);
  return std::abs(offset.dot(a)) >= reach || std::abs(offset.x() * a.y() - offset.y() * a.x()) >= reach;
}

}  // namespace

/// The bins that a dot reaches into; empty: none.
struct DotGrid::Reach {
  int x0, x1, y0, y1;
  std::size_t bins() const {
    return x1 < x0 || y1 < y0 ? 0 : static_cast<std::size_t>(x1 - x0 + 1) * static_cast<std::size_t>(y1 - y0 + 1);
  }
};

DotGrid::DotGrid(const core::DotPattern& dots, core::Footprint footprint, const FaceArea& face)
    : footprint_(footprint), face_(face), count_(dots.size()) {
  core::expects(!dots.empty() && dots.size() < (std::size_t{1} << 31U), "a grid holds some dots, and less than 2^31");
  core::expects(face.x1 > face.x0 && face.y1 > face.y0, "the face of a grid of dots has an area");
  for (const core::Dot& dot : dots) greatest_radius_ = std::max(greatest_radius_, static_cast<double>(dot.radius));
  if (footprint == core::Footprint::square) {
    axes_.reserve(2 * dots.size());
    for (const core::Dot& dot : dots) {
      axes_.push_back(std::cos(dot.angle));
      axes_.push_back(std::sin(dot.angle));
    }
  }
  double size = std::sqrt((face.x1 - face.x0) * (face.y1 - face.y0) / static_cast<double>(dots.size()));
  set_bins(size);
  while (count_entries(dots) > kMostEntries * dots.size() + 1000 && (nx_ > 1 || ny_ > 1)) set_bins(size *= 1.5);
  fill(dots);
}

void DotGrid::set_bins(double size) {
  constexpr double kMostBins = 30000.0;  // along a side
  size = std::max({size, (face_.x1 - face_.x0) / kMostBins, (face_.y1 - face_.y0) / kMostBins});
  bin_ = size;
  per_bin_ = 1.0 / size;
  nx_ = std::max(1, static_cast<int>(std::ceil((face_.x1 - face_.x0) * per_bin_)));
  ny_ = std::max(1, static_cast<int>(std::ceil((face_.y1 - face_.y0) * per_bin_)));
}

DotGrid::Reach DotGrid::reach_of(const core::Dot& dot) const {
  // The place of an entry is rounded.
  const double slack = 1e-6 * std::max(face_.x1 - face_.x0, face_.y1 - face_.y0);
  double half = static_cast<double>(dot.radius) + slack;
  if (footprint_ == core::Footprint::square) half *= std::abs(std::cos(dot.angle)) + std::abs(std::sin(dot.angle));
  const auto low = [&](double at, double from, int count) {
    return std::clamp(static_cast<int>(std::floor(std::clamp((at - half - from) * per_bin_, -1e9, 1e9))), 0, count);
  };
  const auto high = [&](double at, double from, int count) {
    return std::clamp(static_cast<int>(std::floor(std::clamp((at + half - from) * per_bin_, -1e9, 1e9))), -1,
                      count - 1);
  };
  return {low(dot.x, face_.x0, nx_), high(dot.x, face_.x0, nx_), low(dot.y, face_.y0, ny_), high(dot.y, face_.y0, ny_)};
}

std::size_t DotGrid::count_entries(const core::DotPattern& dots) const {
  std::size_t entries = 0;
  for (const core::Dot& dot : dots) entries += reach_of(dot).bins();
  return entries;
}

void DotGrid::fill(const core::DotPattern& dots) {
  starts_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
  const auto each_bin = [&](const core::Dot& dot, auto&& act) {
    const Reach reach = reach_of(dot);
    for (int iy = reach.y0; iy <= reach.y1; ++iy) {
      for (int ix = reach.x0; ix <= reach.x1; ++ix)
        act(static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix));
    }
  };
  for (const core::Dot& dot : dots) each_bin(dot, [&](std::size_t bin) { ++starts_[bin + 1]; });
  for (std::size_t bin = 1; bin < starts_.size(); ++bin) starts_[bin] += starts_[bin - 1];
  entries_.resize(starts_.back());
  // Each start moves to its bin's end, which is the start of the next, and all move back by one.
  for (std::uint32_t i = 0; i < dots.size(); ++i) {
    const Entry entry{static_cast<float>(dots[i].x - face_.x0), static_cast<float>(dots[i].y - face_.y0),
                      dots[i].radius, i};
    each_bin(dots[i], [&](std::size_t bin) { entries_[starts_[bin]++] = entry; });
  }
  for (std::size_t bin = starts_.size() - 1; bin > 0; --bin) starts_[bin] = starts_[bin - 1];
  starts_[0] = 0;
}

int DotGrid::count_at(double u, double v) const {
  const std::size_t bin = bin_at(u, v);
  int count = 0;
  for (std::uint32_t i = starts_[bin]; i < starts_[bin + 1]; ++i) count += holds(entries_[i], u, v) ? 1 : 0;
  return count;
}

core::CellField DotGrid::coverage(const core::CellGrid& cells) const {
  core::CellField area(cells, 0.0);
  std::vector<core::Vec2> points;  // of a dot of radius 1, evenly: a sunflower, or a square lattice
  for (int i = 0; i < kCoveragePoints; ++i) {
    const int row = i / 16, column = i % 16;
    if (footprint_ == core::Footprint::square) {
      points.emplace_back((column + 0.5) / 8.0 - 1.0, (row + 0.5) / 8.0 - 1.0);
    } else {
      const double r = std::sqrt((i + 0.5) / kCoveragePoints), turn = 2.399963229728653 * i;
      points.emplace_back(r * std::cos(turn), r * std::sin(turn));
    }
  }
  const bool apart = overlapping().first < 0;
  std::vector<bool> done(count_, false);
  for (const Entry& e : entries_) {
    if (done[e.dot]) continue;
    done[e.dot] = true;
    const double x = center_x(e), y = center_y(e), r = static_cast<double>(e.radius);
    const double whole = core::footprint_area(footprint_, 2.0 * r) / cells.cell_area();
    const double reach = 1.5 * r;
    const int cell = cells.index_at(x, y);
    if (apart && cell >= 0 && cells.index_at(x - reach, y - reach) == cell &&
        cells.index_at(x + reach, y + reach) == cell) {
      area.values[static_cast<std::size_t>(cell)] += whole;
      continue;
    }
    for (const core::Vec2& point : points) {
      const core::Vec2 place = turned(r * point, axis(e.dot));
      const int in = cells.index_at(x + place.x(), y + place.y());
      if (in < 0) continue;
      const int above = apart ? 1 : std::max(1, count_at(x + place.x() - face_.x0, y + place.y() - face_.y0));
      area.values[static_cast<std::size_t>(in)] += whole / (kCoveragePoints * above);
    }
  }
  for (double& share : area.values) share = std::min(share, 1.0);
  return area;
}

std::pair<int, int> DotGrid::overlapping() const {
  const auto meet = [&](const Entry& a, const Entry& b) {
    const core::Vec2 offset(static_cast<double>(a.x) - static_cast<double>(b.x),
                            static_cast<double>(a.y) - static_cast<double>(b.y));
    // What rounding of the places makes touch is apart.
    const double slack = 2e-7 * std::max(face_.x1 - face_.x0, face_.y1 - face_.y0);
    const double ra = static_cast<double>(a.radius) - slack, rb = static_cast<double>(b.radius) - slack;
    if (ra <= 0.0 || rb <= 0.0) return false;
    if (footprint_ == core::Footprint::round) return offset.norm() < ra + rb;
    return !parted(offset, axis(a.dot), ra, axis(b.dot), rb) && !parted(offset, axis(b.dot), rb, axis(a.dot), ra);
  };
  for (std::size_t bin = 0; bin + 1 < starts_.size(); ++bin) {
    for (std::uint32_t i = starts_[bin]; i < starts_[bin + 1]; ++i) {
      for (std::uint32_t j = i + 1; j < starts_[bin + 1]; ++j) {
        if (meet(entries_[i], entries_[j]))
          return {static_cast<int>(std::min(entries_[i].dot, entries_[j].dot)),
                  static_cast<int>(std::max(entries_[i].dot, entries_[j].dot))};
      }
    }
  }
  return {-1, -1};
}

std::size_t DotGrid::bytes() const {
  return starts_.capacity() * sizeof(std::uint32_t) + entries_.capacity() * sizeof(Entry) +
         axes_.capacity() * sizeof(float);
}

}  // namespace evenglow::tracer

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/dots/dot.h"
#include "core/math/cell_field.h"
#include "core/math/vec3.h"

namespace evenglow::tracer {

/// A rectangle of the patterned face, mm.
struct FaceArea {
  double x0 = 0.0, x1 = 1.0, y0 = 0.0, y1 = 1.0;
};

/// The dots of a pattern one by one, found by place: bins over the face, each with the dots that reach into it.
/// Footprints are round, or squares that each dot's angle turns. Places are kept to 2^-24 of the size of the face (8 nm
/// on a phone's), so that a dot takes about 60 bytes (docs/dots.md).
class DotGrid {
 public:
  /// A dot in a bin.
  struct Entry {
    float x, y;    ///< mm, center, from the corner (x0, y0) of the face
    float radius;  ///< mm, half the width of a square
    std::uint32_t dot;
  };

  /// Throws Error without dots or with more than 2^31. Dots may lie anywhere: what is beyond the face is never found.
  DotGrid(const core::DotPattern& dots, core::Footprint footprint, const FaceArea& face);

  /// The dot whose footprint holds the place (mm; any one of several), -1: none.
  [[gnu::always_inline]] int at(double x, double y) const {
    const double u = x - face_.x0, v = y - face_.y0;
    const std::size_t bin = bin_at(u, v);
    for (std::uint32_t i = starts_[bin]; i < starts_[bin + 1]; ++i) {
      if (holds(entries_[i], u, v)) return static_cast<int>(entries_[i].dot);
    }
    return -1;
  }
  bool covers(double x, double y) const { return at(x, y) >= 0; }

  /// The bins along a way of `length` (mm; may be infinite) from (x, y) in the direction (kx, ky) (mm per mm of way,
  /// may be zero), as far as the face goes: `visit(entries, way)` of each, `way` where it is left; true: enough.
  template <typename Visit>
  void along(double x, double y, double kx, double ky, double length, Visit&& visit) const;

  std::size_t size() const { return count_; }
  core::Footprint footprint() const { return footprint_; }
  const FaceArea& face() const { return face_; }
  double greatest_radius() const { return greatest_radius_; }  ///< mm
  double center_x(const Entry& e) const { return face_.x0 + static_cast<double>(e.x); }
  double center_y(const Entry& e) const { return face_.y0 + static_cast<double>(e.y); }
  /// Cosine and sine of a dot's angle; (1, 0) of all round ones.
  core::Vec2 axis(std::uint32_t dot) const {
    if (axes_.empty()) return {1.0, 0.0};
    return {static_cast<double>(axes_[std::size_t{2} * dot]), static_cast<double>(axes_[std::size_t{2} * dot + 1])};
  }
  /// The entry at a place, null: none.
  const Entry* find(double x, double y) const {
    const double u = x - face_.x0, v = y - face_.y0;
    const std::size_t bin = bin_at(u, v);
    for (std::uint32_t i = starts_[bin]; i < starts_[bin + 1]; ++i) {
      if (holds(entries_[i], u, v)) return &entries_[i];
    }
    return nullptr;
  }

  /// Share of each cell under footprints, by 256 points of each dot that lies in several cells or over another.
  core::CellField coverage(const core::CellGrid& cells) const;
  /// Two dots that overlap (round: nearer than their radii; square: their turned squares meet), or {-1, -1}.
  std::pair<int, int> overlapping() const;
  std::size_t bytes() const;

 private:
  /// Round: within the radius. Square: within half the width along both of its axes.
  [[gnu::always_inline]] bool holds(const Entry& e, double u, double v) const {
    const double dx = u - static_cast<double>(e.x), dy = v - static_cast<double>(e.y);
    const double r = static_cast<double>(e.radius);
    if (axes_.empty()) return dx * dx + dy * dy < r * r;
    const double c = static_cast<double>(axes_[std::size_t{2} * e.dot]),
                 s = static_cast<double>(axes_[std::size_t{2} * e.dot + 1]);
    return std::abs(c * dx + s * dy) < r && std::abs(c * dy - s * dx) < r;
  }
  /// The nearest bin beyond the border.
  [[gnu::always_inline]] std::size_t bin_at(double u, double v) const {
    const int ix = std::clamp(static_cast<int>(u * per_bin_), 0, nx_ - 1);
    const int iy = std::clamp(static_cast<int>(v * per_bin_), 0, ny_ - 1);
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }
  /// Dots that hold the place.
  int count_at(double u, double v) const;
  struct Reach;
  Reach reach_of(const core::Dot& dot) const;
  void set_bins(double size);
  std::size_t count_entries(const core::DotPattern& dots) const;
  void fill(const core::DotPattern& dots);

  core::Footprint footprint_;
  FaceArea face_;
  std::size_t count_ = 0;
  double greatest_radius_ = 0.0;
  double bin_ = 1.0, per_bin_ = 1.0;  ///< mm, 1/mm
  int nx_ = 1, ny_ = 1;
  std::vector<std::uint32_t> starts_;  ///< of each bin, and the end
  std::vector<Entry> entries_;
  std::vector<float> axes_;  ///< cosine and sine of each square dot
};

template <typename Visit>
void DotGrid::along(double x, double y, double kx, double ky, double length, Visit&& visit) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double place[2] = {x - face_.x0, y - face_.y0};
  const double k[2] = {kx, ky};
  const double size[2] = {face_.x1 - face_.x0, face_.y1 - face_.y0};
  const int count[2] = {nx_, ny_};
  double begin = 0.0, end = length;
  for (int axis = 0; axis < 2; ++axis) {
    if (k[axis] == 0.0) {
      if (place[axis] < 0.0 || place[axis] > size[axis]) return;
      continue;
    }
    const double a = -place[axis] / k[axis], b = (size[axis] - place[axis]) / k[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin <= end)) return;
  int bin[2], step[2];
  double next[2], per_bin[2];
  for (int axis = 0; axis < 2; ++axis) {
    const double from = place[axis] + begin * k[axis];
    bin[axis] = std::clamp(static_cast<int>(from * per_bin_), 0, count[axis] - 1);
    step[axis] = k[axis] > 0.0 ? 1 : -1;
    per_bin[axis] = k[axis] != 0.0 ? bin_ / std::abs(k[axis]) : kFar;
    const double wall = (bin[axis] + (k[axis] > 0.0 ? 1 : 0)) * bin_;
    next[axis] = k[axis] != 0.0 ? (wall - place[axis]) / k[axis] : kFar;
  }
  while (true) {
    const int axis = next[0] < next[1] ? 0 : 1;
    const double left = std::min(next[axis], end);
    const std::size_t at =
        static_cast<std::size_t>(bin[1]) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(bin[0]);
    if (visit(std::span<const Entry>(entries_.data() + starts_[at], entries_.data() + starts_[at + 1]), left)) return;
    if (next[axis] >= end) return;
    bin[axis] += step[axis];
    if (bin[axis] < 0 || bin[axis] >= count[axis]) return;
    next[axis] += per_bin[axis];
  }
}

}  // namespace evenglow::tracer

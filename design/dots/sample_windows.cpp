#include "design/dots/sample_windows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace evenglow::design {
namespace {

constexpr int kRaster = 8;
constexpr double kMostSlope = 0.5;

bool is_free(const FreeArea& free, double x0, double y0, double size) {
  constexpr int kPoints = 16;
  for (int j = 0; j <= kPoints; ++j) {
    for (int i = 0; i <= kPoints; ++i) {
      if (free.clearance(x0 + size * i / kPoints, y0 + size * j / kPoints, size) < -1e-9 * size) return false;
    }
  }
  return true;
}

std::size_t count_in(const DotStore& store, double x, double y, double half) {
  std::size_t count = 0;
  store.near(x, y, half, [&](std::size_t i) {
    count += std::abs(store.dots().x[i] - x) < half && std::abs(store.dots().y[i] - y) < half;
  });
  return count;
}

}  // namespace

SampleWindow cut_window(const DotStore& store, double x0, double y0, double size) {
  SampleWindow window;
  window.x0 = x0;
  window.y0 = y0;
  window.size = size;
  const auto& dots = store.dots();
  store.near(x0 + 0.5 * size, y0 + 0.5 * size, 0.5 * size, [&](std::size_t i) {
    const double x = (dots.x[i] - x0) / size, y = (dots.y[i] - y0) / size;
    if (!(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0)) return;
    window.x.push_back(x);
    window.y.push_back(y);
    window.area.push_back(core::footprint_area(core::Footprint::round, static_cast<double>(dots.diameter[i])));
  });
  const auto slope = [&](const std::vector<double>& values) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    return 12.0 * (mean - 0.5);
  };
  if (window.x.empty()) return window;
  window.slope_x = slope(window.x);
  window.slope_y = slope(window.y);
  return window;
}

std::vector<SampleWindow> sample_windows(const DotStore& store, const FreeArea& free, double wanted) {
  const RectangleZone& box = free.bounds();
  const double length = box.x1 - box.x0, width = box.y1 - box.y0;
  std::vector<SampleWindow> windows;
  for (int k = 0; k < kRaster * kRaster; ++k) {
    const int column = k % kRaster, row = k / kRaster;
    const double x = box.x0 + (column + 0.5) / kRaster * length;
    const double y = box.y0 + (row + 0.5) / kRaster * width;
    double size = std::sqrt(wanted * length * width / static_cast<double>(store.size()));
    for (int step = 0; step < 4; ++step) {
      size = std::min({size, length, width});
      const auto count = static_cast<double>(count_in(store, x, y, 0.5 * size));
      size *= std::clamp(std::sqrt(wanted / std::max(count, 1.0)), 0.25, 4.0);
    }
    size = std::min({size, length, width});
    const double x0 = std::clamp(x - 0.5 * size, box.x0, box.x1 - size);
    const double y0 = std::clamp(y - 0.5 * size, box.y0, box.y1 - size);
    if (!is_free(free, x0, y0, size)) continue;
    SampleWindow window = cut_window(store, x0, y0, size);
    if (static_cast<double>(window.x.size()) < 0.25 * wanted) continue;
    if (std::abs(window.slope_x) + std::abs(window.slope_y) > kMostSlope) continue;
    windows.push_back(std::move(window));
  }
  return windows;
}

}  // namespace evenglow::design

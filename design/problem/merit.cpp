#include "design/problem/merit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/math/cell_index.h"
#include "design/problem/pair_statistic.h"

namespace evenglow::design {
namespace {

using core::CellField;
using core::Tally;

constexpr double kTwoSided95 = 1.959964;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double v : x) sum += v;
  return sum / static_cast<double>(x.size());
}

/// Batch maps over the overall mean of a batch, each less its own spatial mean.
std::vector<std::vector<double>> centered_batches(const Tally& tally, double batch_mean) {
  std::vector<std::vector<double>> y;
  y.reserve(tally.batches());
  for (std::size_t b = 0; b < tally.batches(); ++b) {
    y.push_back(tally.batch(b));
    const double own = mean_of(y.back());
    for (double& v : y.back()) v = (v - own) / batch_mean;
  }
  return y;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Products of the batch maps, averaged over the cells.
BatchProducts products_of(const std::vector<std::vector<double>>& y) {
  const double cells = static_cast<double>(y.front().size());
  BatchProducts h(y.size());
  for (std::size_t b = 0; b < y.size(); ++b) {
    for (std::size_t c = 0; c < b; ++c) h.at(b, c) = dot(y[b], y[c]) / cells;
  }
  return h;
}

struct Point {
  double u, v;
};

double spot(const CellField& field, Point at) {
  const core::CellGrid& g = field.grid;
  const double width = g.nx * g.dx;
  const double height = g.ny * g.dy;
  const double x = g.x0 + at.u * width;
  const double y = g.y0 + at.v * height;
  const double radius = 0.04 * std::hypot(width, height);
  double sum = 0.0;
  int count = 0;
  bool has_cells = false;
  for (int iy = 0; iy < g.ny; ++iy) {
    for (int ix = 0; ix < g.nx; ++ix) {
      if (std::hypot(g.center_x(ix) - x, g.center_y(iy) - y) > radius) continue;
      has_cells = true;
      const double value = field.values[core::cell_index(g.nx, ix, iy)];
      if (std::isnan(value)) continue;
      sum += value;
      ++count;
    }
  }
  if (!has_cells) return field.at(x, y);
  return count > 0 ? sum / count : kNone;
}

double uniformity(const CellField& field, const std::vector<Point>& points) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Point& point : points) {
    const double value = spot(field, point);
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high > 0.0 ? low / high : kNone;
}

/// The standard error from the values with one batch left out.
double jackknife_se(const std::vector<double>& without_one) {
  const double mean = mean_of(without_one);
  const double count = static_cast<double>(without_one.size());
  double squares = 0.0;
  for (const double v : without_one) squares += (v - mean) * (v - mean);
  return std::sqrt(squares * (count - 1.0) / count);
}

std::vector<Point> nine_points() {
  std::vector<Point> points;
  for (const double v : {0.1, 0.5, 0.9}) {
    for (const double u : {0.1, 0.5, 0.9}) points.push_back({u, v});
  }
  return points;
}

std::vector<Point> thirteen_points() {
  std::vector<Point> points = nine_points();
  for (const double v : {0.3, 0.7}) {
    for (const double u : {0.3, 0.7}) points.push_back({u, v});
  }
  return points;
}

}  // namespace

core::Estimate mean_of_cells(const Tally& luminance) {
  std::vector<double> means;
  for (std::size_t b = 0; b < luminance.batches(); ++b) means.push_back(mean_of(luminance.batch(b)));
  return core::total_of_batches(means);
}

Evenness evenness(const Tally& luminance) {
  core::expects(luminance.batches() >= 3 && luminance.bins() > 0, "at least 3 batches of at least one cell");
  std::vector<double> total(luminance.bins(), 0.0);
  std::vector<double> means;
  for (std::size_t b = 0; b < luminance.batches(); ++b) {
    const auto& batch = luminance.batch(b);
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += batch[i];
    means.push_back(mean_of(batch));
  }
  Evenness result;
  result.mean = core::total_of_batches(means);
  if (result.mean.value <= 0.0) return {kNone, {kNone, kNone}, kNone, kNone, result.mean};
  double squares = 0.0;
  for (const double v : total) squares += (v - result.mean.value) * (v - result.mean.value);
  result.rms = std::sqrt(squares / static_cast<double>(total.size())) / result.mean.value;
  const auto y = centered_batches(luminance, result.mean.value / static_cast<double>(luminance.batches()));
  const core::Estimate square = pair_statistic(products_of(y));
  result.rms_corrected = signed_root(square.value, square.se);
  result.low = std::sqrt(std::max(0.0, square.value - kTwoSided95 * square.se));
  result.high = std::sqrt(std::max(0.0, square.value) + kTwoSided95 * square.se);
  return result;
}

CellField counted_only(CellField luminance, const CellField& target) {
  if (target.values.empty()) return luminance;
  core::expects(target.values.size() == luminance.values.size(), "luminance and target on the same cells");
  for (std::size_t i = 0; i < luminance.values.size(); ++i) {
    if (target.values[i] == 0.0) luminance.values[i] = kNone;
  }
  return luminance;
}

double uniformity_9(const CellField& luminance) {
  return uniformity(luminance, nine_points());
}

double uniformity_13(const CellField& luminance) {
  return uniformity(luminance, thirteen_points());
}

std::vector<SpotValue> uniformity_spots(const CellField& luminance) {
  const core::CellGrid& g = luminance.grid;
  std::vector<SpotValue> spots;
  for (const Point& point : thirteen_points())
    spots.push_back({g.x0 + point.u * g.nx * g.dx, g.y0 + point.v * g.ny * g.dy, spot(luminance, point)});
  return spots;
}

double center_luminance(const CellField& luminance) {
  return spot(luminance, {0.5, 0.5});
}

SpotErrors spot_errors(const Tally& luminance, const CellField& target) {
  const std::size_t batches = luminance.batches();
  const core::CellGrid& grid = target.grid;
  core::expects(batches >= 2 && luminance.bins() == grid.size(), "at least 2 batches of the cells of the grid");
  CellField total(grid, 0.0);
  for (std::size_t b = 0; b < batches; ++b) {
    for (std::size_t i = 0; i < total.values.size(); ++i) total.values[i] += luminance.batch(b)[i];
  }
  const double scale = static_cast<double>(batches) / static_cast<double>(batches - 1);
  std::vector<double> nine, thirteen, center;
  CellField rest(grid, 0.0);
  for (std::size_t b = 0; b < batches; ++b) {
    for (std::size_t i = 0; i < rest.values.size(); ++i)
      rest.values[i] = (total.values[i] - luminance.batch(b)[i]) * scale;
    const CellField counted = counted_only(rest, target);
    nine.push_back(uniformity_9(counted));
    thirteen.push_back(uniformity_13(counted));
    center.push_back(center_luminance(counted));
  }
  return {jackknife_se(nine), jackknife_se(thirteen), jackknife_se(center)};
}

}  // namespace evenglow::design

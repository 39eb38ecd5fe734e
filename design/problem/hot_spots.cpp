#include "design/problem/hot_spots.h"

#include <algorithm>
#include <cmath>

namespace evenglow::design {
namespace {

constexpr double kShows = 0.02;
/// Less than this of what is in front of LEDs lies apart from what is between them: the cells are too coarse.
constexpr double kLeastApart = 0.3;
constexpr double kWindowSlack = 1e-9;  // mm

/// Cells of a line along the edge, and how the lines lie.
struct Lines {
  int count = 0;   ///< of lines
  int length = 0;  ///< cells of a line
  double along0 = 0.0, along_step = 0.0;
  double across0 = 0.0, across_step = 0.0;
  int nx = 1;
  bool along_y = true;

  Lines(const core::CellGrid& g, bool runs_along_y)
      : count(runs_along_y ? g.nx : g.ny),
        length(runs_along_y ? g.ny : g.nx),
        along0(runs_along_y ? g.y0 : g.x0),
        along_step(runs_along_y ? g.dy : g.dx),
        across0(runs_along_y ? g.x0 : g.y0),
        across_step(runs_along_y ? g.dx : g.dy),
        nx(g.nx),
        along_y(runs_along_y) {}

  std::size_t index(int line, int i) const { return static_cast<std::size_t>(along_y ? i * nx + line : line * nx + i); }
  double end() const { return along0 + along_step * length; }
};

/// Adds `share` of the mean over [min, max] to the weights of a line's cells.
void add_mean(const Lines& lines, const LedWindow& window, double share, std::vector<double>& weights) {
  for (int i = 0; i < lines.length; ++i) {
    const double low = lines.along0 + lines.along_step * i;
    const double overlap = std::min(low + lines.along_step, window.max) - std::max(low, window.min);
    if (overlap > 0.0) weights[static_cast<std::size_t>(i)] += share * overlap / (window.max - window.min);
  }
}

/// Weights of a line's cells, and what they stand for.
struct Weights {
  std::vector<double> front, between;
  int gaps = 0;
  double led_width = 0.0, gap_width = 0.0;
};

Weights weights_of(const Lines& lines, std::vector<LedWindow> windows) {
  std::sort(windows.begin(), windows.end(), [](const LedWindow& a, const LedWindow& b) { return a.min < b.min; });
  const auto cells = static_cast<std::size_t>(lines.length);
  Weights weights{std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)};
  for (std::size_t i = 0; i + 1 < windows.size(); ++i) {
    const LedWindow& a = windows[i];
    const LedWindow& b = windows[i + 1];
    const bool shown = a.min >= lines.along0 - kWindowSlack && b.max <= lines.end() + kWindowSlack;
    const double gap = b.min - a.max;
    const double led = 0.5 * (a.max - a.min + b.max - b.min);
    if (!shown || gap <= kWindowSlack || led <= 0.0) continue;
    const double middle = 0.5 * (a.max + b.min), half = 0.5 * std::min(gap, led);
    add_mean(lines, a, 0.5, weights.front);
    add_mean(lines, b, 0.5, weights.front);
    add_mean(lines, {middle - half, middle + half}, 1.0, weights.between);
    ++weights.gaps;
    weights.led_width += led;
    weights.gap_width += gap;
  }
  for (std::vector<double>* list : {&weights.front, &weights.between}) {
    for (double& weight : *list) weight /= std::max(weights.gaps, 1);
  }
  weights.led_width /= std::max(weights.gaps, 1);
  weights.gap_width /= std::max(weights.gaps, 1);
  return weights;
}

/// 1: no cell is both in front of an LED and between two; 0: all cells are so alike.
double apart(const Weights& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.front.size(); ++i) sum += std::abs(weights.front[i] - weights.between[i]);
  return 0.5 * sum;
}

std::vector<double> line_sums(const Lines& lines, int line, const std::vector<double>& weights,
                              const core::Tally& luminance, double unit) {
  std::vector<double> sums;
  for (std::size_t b = 0; b < luminance.batches(); ++b) {
    double sum = 0.0;
    for (int i = 0; i < lines.length; ++i) {
      sum += weights[static_cast<std::size_t>(i)] * luminance.batch(b)[lines.index(line, i)];
    }
    sums.push_back(unit * sum);
  }
  return sums;
}

/// a / b of sums over the same batches: residuals a_b - ratio b_b.
core::Estimate batch_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  const core::Estimate below = core::total_of_batches(b);
  const double ratio = core::total_of_batches(a).value / below.value;
  std::vector<double> residuals;
  for (std::size_t i = 0; i < a.size(); ++i) residuals.push_back((a[i] - ratio * b[i]) / below.value);
  return {ratio, core::total_of_batches(residuals).se};
}

bool shows(const HotSpotLine& line) {
  return !(std::abs(line.ratio.value - 1.0) <= kShows + 2.0 * line.ratio.se);
}

/// The far border of the last line where the LEDs show; none if that is the last of all.
std::optional<double> mixing_distance(const std::vector<HotSpotLine>& lines, double step) {
  const auto last = std::find_if(lines.rbegin(), lines.rend(), shows);
  if (last == lines.rbegin()) return std::nullopt;
  return last == lines.rend() ? lines.front().distance - 0.5 * step : last->distance + 0.5 * step;
}

}  // namespace

std::optional<HotSpots> hot_spots(const LedEdge& edge, const core::CellGrid& cells, const core::Tally& luminance,
                                  double unit) {
  const Lines lines(cells, edge.along_y);
  const Weights weights = weights_of(lines, edge.windows);
  if (weights.gaps == 0 || apart(weights) < kLeastApart || luminance.batches() == 0) return std::nullopt;
  const std::vector<double> ones(luminance.bins(), 1.0);
  if (luminance.weighted_total(ones).value <= 0.0) return std::nullopt;
  HotSpots result{edge.source, edge.name, weights.gaps, weights.led_width, weights.gap_width, {}, {}};
  for (int line = 0; line < lines.count; ++line) {
    const std::vector<double> front = line_sums(lines, line, weights.front, luminance, unit);
    const std::vector<double> between = line_sums(lines, line, weights.between, luminance, unit);
    result.lines.push_back({std::abs(lines.across0 + lines.across_step * (line + 0.5) - edge.place),
                            core::total_of_batches(front), core::total_of_batches(between),
                            batch_ratio(front, between)});
  }
  std::sort(result.lines.begin(), result.lines.end(),
            [](const HotSpotLine& a, const HotSpotLine& b) { return a.distance < b.distance; });
  result.mixing_distance = mixing_distance(result.lines, lines.across_step);
  return result;
}

}  // namespace evenglow::design

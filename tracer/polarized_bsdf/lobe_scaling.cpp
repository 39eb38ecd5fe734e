#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Core>

#include "tracer/polarized_bsdf/lobe_model.h"

/// The symmetric scaling c of `LobeModel`.
namespace evenglow::tracer {
namespace {

using Grid = Eigen::ArrayXXd;
using Eigen::Index;

constexpr int kMostSteps = 20000;
constexpr double kTolerance = 1e-10;

/// Share of the cell around the node (x, y) of a grid of this step that lies inside the unit circle.
double coverage(double x, double y, double step) {
  constexpr int kParts = 32;
  int hits = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      const double px = x + ((i + 0.5) / kParts - 0.5) * step, py = y + ((j + 0.5) / kParts - 0.5) * step;
      hits += px * px + py * py < 1.0 ? 1 : 0;
    }
  }
  return static_cast<double>(hits) / (kParts * kParts);
}

/// Sum over a line of nodes of exp(-(x_i - x_j)^2 / 2 s^2) step, nodes j and -j together.
Eigen::MatrixXd line_of(double s, Index n, double step) {
  Eigen::MatrixXd g(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double near = static_cast<double>(i - j) * step / s, far = static_cast<double>(i + j) * step / s;
      g(i, j) = step * (std::exp(-0.5 * near * near) + (j > 0 ? std::exp(-0.5 * far * far) : 0.0));
    }
  }
  return g;
}

/// Nodes without a value get the mean of their neighbors that have one, from the rim outwards.
void fill_outside(Grid& c, Grid known) {
  const Index n = c.rows();
  while ((known == 0.0).any()) {
    Grid next = c, now = known;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        if (known(i, j) > 0.0) continue;
        double sum = 0.0, count = 0.0;
        for (Index x = std::max<Index>(i - 1, 0); x <= std::min(i + 1, n - 1); ++x) {
          for (Index y = std::max<Index>(j - 1, 0); y <= std::min(j + 1, n - 1); ++y) {
            if (known(x, y) == 0.0) continue;
            sum += c(x, y);
            ++count;
          }
        }
        if (count == 0.0) continue;
        next(i, j) = sum / count;
        now(i, j) = 1.0;
      }
    }
    c = next;
    known = now;
  }
}

}  // namespace

/// Fixed point c <- c sqrt(rho / (c K c)) on the nodes of a square grid of step 0.025, cells cut by the unit circle
/// counting by their part inside; one quadrant, as the lobes are even in dx and in dy. A lobe is a product of functions
/// of x and of y, so that K c is two small matrix products.
void LobeModel::solve(ScatterKind kind, FilmLight light) {
  Part& part = parts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(light)];
  const auto n = static_cast<Index>(kNodes);
  const double step = 1.0 / static_cast<double>(kSteps);
  Grid area(n, n), rho(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double x = static_cast<double>(i) * step, y = static_cast<double>(j) * step;
      area(i, j) = coverage(x, y, step);
      rho(i, j) = hemispherical(kind, light, std::asin(std::min(std::hypot(x, y), 1.0)));
    }
  }
  const auto lines_of = [&](const std::vector<Lobe>& lobes) {
    std::vector<std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> lines;
    lines.reserve(lobes.size());
    for (const Lobe& lobe : lobes) {
      lines.emplace_back(lobe.amplitude * line_of(lobe.sx, n, step), line_of(lobe.sy, n, step).transpose());
    }
    return lines;
  };
  const auto spread = [&](const auto& lines, const Grid& c) {
    Grid sum = Grid::Zero(n, n);
    for (const auto& [along_x, along_y] : lines) sum += (along_x * (c * area).matrix() * along_y).array();
    return sum;
  };
  const Grid inside = (area > 0.0).cast<double>();
  const Grid wanted = (rho - spread(lines_of(part.fixed), inside)).max(0.0);
  const auto lines = lines_of(part.scaled);
  Grid c = inside;
  for (int i = 0; i < kMostSteps; ++i) {
    const Grid next = inside * (c * wanted / spread(lines, c).max(1e-300)).sqrt();
    const double change = (next - c).abs().maxCoeff();
    c = next;
    if (change < kTolerance) break;
  }
  fill_outside(c, inside);
  part.c.resize(kNodes * kNodes);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) part.c[static_cast<std::size_t>(i * n + j)] = c(i, j);
  }
}

}  // namespace evenglow::tracer

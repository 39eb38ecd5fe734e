#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "core/base/error.h"
#include "tracer/polarized_bsdf/lobe_model.h"

/// The symmetric scaling c of `LobeModel`.
namespace evenglow::tracer {
namespace {

constexpr int kMostSteps = 20000;
constexpr double kTolerance = 1e-9;

}  // namespace

/// Fixed point c <- c sqrt(rho / (c K c)) on the nodes of a square grid of step 0.025 inside the unit circle, one
/// quadrant of it (the lobes are even in dx and in dy). A lobe is a product of functions of x and of y, so that K c is
/// two small matrix products.
void LobeModel::solve(ScatterKind kind, FilmLight light) {
  using Grid = Eigen::ArrayXXd;
  using Eigen::Index;
  Part& part = parts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(light)];
  const Index n = static_cast<Index>(kNodes);
  const double step = 1.0 / static_cast<double>(kSteps);
  Grid inside(n, n), rho(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double r2 = static_cast<double>(i * i + j * j) * step * step;
      inside(i, j) = r2 < 1.0 - 1e-12 ? 1.0 : 0.0;
      rho(i, j) = hemispherical(kind, light, std::asin(std::sqrt(std::min(r2, 1.0))));
    }
  }
  const auto line = [&](double s) {  // the mirror image of each node counts with it
    Eigen::MatrixXd g(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const double near = static_cast<double>(i - j) * step / s, far = static_cast<double>(i + j) * step / s;
        g(i, j) = step * (std::exp(-0.5 * near * near) + (j > 0 ? std::exp(-0.5 * far * far) : 0.0));
      }
    }
    return g;
  };
  const auto spread = [&](const std::vector<Lobe>& lobes) {
    std::vector<std::pair<Eigen::MatrixXd, Eigen::MatrixXd>> lines;
    for (const Lobe& lobe : lobes) lines.emplace_back(lobe.amplitude * line(lobe.sx), line(lobe.sy).transpose());
    return lines;
  };
  const auto apply = [&](const auto& lines, const Grid& c) {
    Grid sum = Grid::Zero(n, n);
    for (const auto& [along_x, along_y] : lines) sum += (along_x * c.matrix() * along_y).array();
    return sum;
  };
  const Grid wanted = rho - apply(spread(part.fixed), inside);
  const auto lines = spread(part.scaled);
  Grid c = inside;
  for (int i = 0; i < kMostSteps; ++i) {
    const Grid next = (inside > 0.0).select(c * (wanted.max(1e-12) / (c * apply(lines, c)).max(1e-300)).sqrt(), 0.0);
    const double change = (next - c).abs().maxCoeff();
    c = next;
    if (change < kTolerance) break;
  }
  part.c.assign(kNodes * kNodes, 0.0);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) part.c[static_cast<std::size_t>(i * n + j)] = c(i, j);
  }
}

}  // namespace evenglow::tracer

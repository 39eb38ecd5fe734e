#include "core/math/cell_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/math/cell_index.h"

namespace evenglow::core {
namespace {

int clamped_cell(double position, double origin, double size, int count) {
  // What is cut off after the clamp is what floor would have cut off.
  return static_cast<int>(std::clamp((position - origin) / size, 0.0, static_cast<double>(count - 1)));
}

/// Position of a reflected index: ... 1 0 | 0 1 2 ... n-1 | n-1 n-2 ...
int reflected(int i, int n) {
  const int period = 2 * n;
  i = ((i % period) + period) % period;
  return i < n ? i : period - 1 - i;
}

std::vector<double> gaussian_kernel(double sigma) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> kernel(static_cast<std::size_t>(2 * radius + 1));
  for (int i = -radius; i <= radius; ++i) {
    kernel[static_cast<std::size_t>(i + std::ptrdiff_t{radius})] = std::exp(-0.5 * i * i / (sigma * sigma));
  }
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

/// Convolves `count` values that lie `stride` apart.
void convolve_line(const double* in, double* out, int count, int stride, const std::vector<double>& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int k = -radius; k <= radius; ++k) {
      sum += kernel[static_cast<std::size_t>(k + std::ptrdiff_t{radius})] *
             in[std::ptrdiff_t{reflected(i + k, count)} * stride];
    }
    out[std::ptrdiff_t{i} * stride] = sum;
  }
}

}  // namespace

CellGrid CellGrid::over(int nx, int ny, double x0, double y0, double x1, double y1) {
  return {nx, ny, x0, y0, (x1 - x0) / nx, (y1 - y0) / ny};
}

int CellGrid::index_at(double x, double y) const {
  const double u = (x - x0) / dx;
  const double v = (y - y0) / dy;
  if (!(u >= 0.0 && v >= 0.0 && u < nx && v < ny)) return -1;
  return static_cast<int>(v) * nx + static_cast<int>(u);
}

int CellGrid::nearest_index(double x, double y) const {
  return clamped_cell(y, y0, dy, ny) * nx + clamped_cell(x, x0, dx, nx);
}

double CellField::mean() const {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double CellField::min() const {
  return *std::min_element(values.begin(), values.end());
}

double CellField::max() const {
  return *std::max_element(values.begin(), values.end());
}

CellField resample_nearest(const CellField& field, const CellGrid& grid) {
  CellField result(grid, 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      result.values[cell_index(grid.nx, ix, iy)] = field.at(grid.center_x(ix), grid.center_y(iy));
    }
  }
  return result;
}

CellField resample_bilinear(const CellField& field, const CellGrid& grid) {
  const CellGrid& from = field.grid;
  const auto split = [](double position, int count) {
    const double at = std::clamp(position - 0.5, 0.0, static_cast<double>(count - 1));
    const int low = std::min(static_cast<int>(at), std::max(0, count - 2));
    return std::pair{low, count > 1 ? at - low : 0.0};
  };
  CellField result(grid, 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const auto [y, fy] = split((grid.center_y(iy) - from.y0) / from.dy, from.ny);
    const int y1 = std::min(y + 1, from.ny - 1);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const auto [x, fx] = split((grid.center_x(ix) - from.x0) / from.dx, from.nx);
      const int x1 = std::min(x + 1, from.nx - 1);
      const auto value = [&](int i, int j) { return field.values[cell_index(from.nx, i, j)]; };
      result.values[cell_index(grid.nx, ix, iy)] = (1.0 - fy) * ((1.0 - fx) * value(x, y) + fx * value(x1, y)) +
                                                   fy * ((1.0 - fx) * value(x, y1) + fx * value(x1, y1));
    }
  }
  return result;
}

CellField smooth_gaussian(const CellField& field, double sigma_x, double sigma_y) {
  const int nx = field.grid.nx;
  const int ny = field.grid.ny;
  CellField rows = field;
  if (sigma_x > 0.0) {
    const std::vector<double> kernel = gaussian_kernel(sigma_x);
    for (int iy = 0; iy < ny; ++iy) {
      convolve_line(&field.values[cell_index(nx, 0, iy)], &rows.values[cell_index(nx, 0, iy)], nx, 1, kernel);
    }
  }
  if (sigma_y <= 0.0) return rows;
  const std::vector<double> kernel = gaussian_kernel(sigma_y);
  CellField result = rows;
  for (int ix = 0; ix < nx; ++ix) convolve_line(rows.values.data() + ix, result.values.data() + ix, ny, nx, kernel);
  return result;
}

}  // namespace evenglow::core

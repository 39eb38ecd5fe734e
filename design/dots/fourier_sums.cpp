#include "design/dots/fourier_sums.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace evenglow::design {
namespace {

/// exp(-2 pi i f x) for each frequency of the row, by recurrence in double precision.
template <typename Column>
void fill_phases(double x, double weight, const FrequencyRow& row, Column&& column) {
  const auto phase = [x](double frequency) {
    return std::polar(1.0, -2.0 * std::numbers::pi * std::remainder(frequency * x, 1.0));
  };
  std::complex<double> value = weight * phase(row.first);
  const std::complex<double> factor = phase(row.step);
  for (int k = 0; k < row.count; ++k) {
    column(k) = std::complex<float>(value);
    value *= factor;
  }
}

}  // namespace

Eigen::MatrixXcf fourier_sums(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& w,
                              const FrequencyRow& fx, const FrequencyRow& fy) {
  constexpr std::size_t kBlock = 512;  // dots at a time: bounds the memory
  Eigen::MatrixXcf sums = Eigen::MatrixXcf::Zero(fy.count, fx.count);
  for (std::size_t begin = 0; begin < x.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, x.size() - begin);
    Eigen::MatrixXcf along_x(fx.count, static_cast<Eigen::Index>(count)),
        along_y(fy.count, static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      fill_phases(x[begin + i], w.empty() ? 1.0 : w[begin + i], fx, along_x.col(column));
      fill_phases(y[begin + i], 1.0, fy, along_y.col(column));
    }
    sums.noalias() += along_y * along_x.transpose();
  }
  return sums;
}

}  // namespace evenglow::design

#include "design/dots/power_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/montecarlo/batches.h"
#include "design/dots/fourier_sums.h"

namespace evenglow::design {
namespace {

constexpr double kReach = 3.0;
constexpr std::size_t kSide = 2 * PowerSpectrum::kHalf + 1;
constexpr std::size_t kDirections = 36;

struct Sums {
  std::vector<double> radial = std::vector<double>(PowerSpectrum::kBins, 0.0), radial_count = radial;
  std::vector<double> map = std::vector<double>(kSide * kSide, 0.0), map_count = map;
  std::array<double, kDirections> direction{}, direction_count{};
};

void add_power(double u, double v, double power, Sums& sums) {
  const double f = std::hypot(u, v);
  const auto bin = static_cast<std::size_t>(f / PowerSpectrum::kBin);
  if (bin < sums.radial.size()) {
    sums.radial[bin] += power;
    ++sums.radial_count[bin];
  }
  if (f >= 0.8 && f < 1.4) {
    const double turn = std::atan2(v, u) / std::numbers::pi;  // in [0, 1] for v >= 0
    const auto direction = std::min(kDirections - 1, static_cast<std::size_t>(turn * kDirections));
    sums.direction[direction] += power;
    ++sums.direction_count[direction];
  }
  for (const double sign : {1.0, -1.0}) {
    const double column = std::round((sign * u / kReach + 1.0) * PowerSpectrum::kHalf);
    const double row = std::round((sign * v / kReach + 1.0) * PowerSpectrum::kHalf);
    if (column < 0.0 || row < 0.0 || column >= kSide || row >= kSide) continue;
    const std::size_t at = static_cast<std::size_t>(row) * kSide + static_cast<std::size_t>(column);
    sums.map[at] += power;
    ++sums.map_count[at];
  }
}

void add_window(const SampleWindow& window, Sums& sums) {
  const auto n = static_cast<double>(window.x.size());
  const int most = static_cast<int>(kReach * std::sqrt(n));
  const auto z =
      fourier_sums(window.x, window.y, {}, {-static_cast<double>(most), 1.0, 2 * most + 1}, {0.0, 1.0, most + 1});
  for (int ky = 0; ky <= most; ++ky) {
    for (int kx = ky == 0 ? 1 : -most; kx <= most; ++kx) {
      std::complex<double> value(z(ky, kx + most));
      // The transform of the linear density: slope N i / (2 pi k) on the axes, 0 elsewhere.
      const double slope = ky == 0 ? window.slope_x / kx : kx == 0 ? window.slope_y / ky : 0.0;
      value -= std::complex<double>(0.0, slope * n / (2.0 * std::numbers::pi));
      add_power(kx / std::sqrt(n), ky / std::sqrt(n), std::norm(value) / n, sums);
    }
  }
}

void add(const std::vector<double>& part, std::vector<double>& whole) {
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i] += part[i];
}

void take_means(const Sums& sums, PowerSpectrum& result) {
  const auto mean = [](double sum, double count) {
    return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t i = 0; i < sums.radial.size(); ++i)
    result.radial.push_back(mean(sums.radial[i], sums.radial_count[i]));
  for (std::size_t i = 0; i < sums.map.size(); ++i) result.map.push_back(mean(sums.map[i], sums.map_count[i]));
  double low = 0.0, low_count = 0.0;
  for (std::size_t i = 2; i < 10; ++i) {
    low += sums.radial[i];
    low_count += sums.radial_count[i];
  }
  result.low_power = mean(low, low_count);
  for (std::size_t i = 0; i < result.radial.size(); ++i) {
    if (!(result.radial[i] > result.peak_power)) continue;
    result.peak_power = result.radial[i];
    result.peak_frequency = (static_cast<double>(i) + 0.5) * PowerSpectrum::kBin;
  }
  double all = 0.0, count = 0.0, most = 0.0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    all += sums.direction[i];
    count += sums.direction_count[i];
    if (sums.direction_count[i] > 0.0) most = std::max(most, sums.direction[i] / sums.direction_count[i]);
  }
  result.direction_contrast = all > 0.0 ? most / (all / count) : 0.0;
}

}  // namespace

PowerSpectrum power_spectrum(const std::vector<SampleWindow>& windows, int threads) {
  std::vector<Sums> parts(windows.size());
  core::run_batches(windows.size(), threads, [&](std::size_t i) { add_window(windows[i], parts[i]); });
  Sums sums;
  for (const Sums& part : parts) {
    add(part.radial, sums.radial);
    add(part.radial_count, sums.radial_count);
    add(part.map, sums.map);
    add(part.map_count, sums.map_count);
    for (std::size_t i = 0; i < kDirections; ++i) {
      sums.direction[i] += part.direction[i];
      sums.direction_count[i] += part.direction_count[i];
    }
  }
  PowerSpectrum result;
  result.windows = windows.size();
  take_means(sums, result);
  return result;
}

}  // namespace evenglow::design

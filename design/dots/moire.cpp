#include "design/dots/moire.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/montecarlo/batches.h"
#include "design/dots/fourier_sums.h"

namespace evenglow::design {
namespace {

constexpr int kOrders = 2;
constexpr int kSquares = 3;          // along each side
constexpr double kFinestBeat = 0.5;  // mm
constexpr double kSlowest = 1.0;     // 1/mm: what varies slower is the density's own profile
/// A frequency's power over that of dots out of step is exponential with the spectrum (at most about 4 at the ring of
/// blue noise) as its mean: exp(-25) for each of a few 1e5.
constexpr double kInStep = 100.0;

struct Harmonic {
  const Grating* grating;
  int order_x, order_y;
  double fx, fy;  ///< 1/mm, on the plate
  double amplitude;
};

double aperture_amplitude(int order, double aperture) {
  if (order == 0) return 1.0;
  const double u = std::numbers::pi * order * aperture;
  return std::abs(std::sin(u) / u);
}

std::vector<Harmonic> harmonics_of(const std::vector<Grating>& gratings, const MoireSettings& settings) {
  std::vector<Harmonic> all;
  for (const Grating& grating : gratings) {
    const GratingSpec& lines = grating.lines;
    const int rows = lines.pitch_y > 0.0 ? kOrders : 0;
    for (int oy = 0; oy <= rows; ++oy) {
      for (int ox = oy == 0 ? 1 : -kOrders; ox <= kOrders; ++ox) {
        const double u = ox / lines.pitch_x, v = oy == 0 ? 0.0 : oy / lines.pitch_y;
        const double amplitude =
            grating.is_panel ? aperture_amplitude(ox, settings.aperture) * aperture_amplitude(oy, settings.aperture)
                             : settings.prism_amplitude / ox;
        const double c = std::cos(lines.angle), s = std::sin(lines.angle);
        all.push_back({&grating, ox, oy, c * u - s * v, s * u + c * v, amplitude});
      }
    }
  }
  return all;
}

/// Fourier transform of a disc of this diameter over its area.
double disc_shape(double frequency, double diameter) {
  const double u = std::numbers::pi * frequency * diameter;
  return u < 1e-6 ? 1.0 : std::abs(2.0 * ::j1(u) / u);
}

struct WindowSums {
  double area = 0.0, area2 = 0.0, diameter = 0.0;
};

WindowSums sums_of(const SampleWindow& window) {
  WindowSums sums;
  for (const double a : window.area) {
    sums.area += a;
    sums.area2 += a * a;
  }
  sums.diameter = std::sqrt(4.0 / std::numbers::pi * sums.area2 / sums.area);
  return sums;
}

/// Whether no frequency next to it has more power: the flanks of a line are not the line.
bool is_peak(const Eigen::MatrixXcf& z, Eigen::Index row, Eigen::Index column) {
  const Eigen::Index r0 = std::max<Eigen::Index>(row - 1, 0), r1 = std::min(row + 1, z.rows() - 1);
  const Eigen::Index c0 = std::max<Eigen::Index>(column - 1, 0), c1 = std::min(column + 1, z.cols() - 1);
  return std::norm(z(row, column)) >= z.block(r0, c0, r1 - r0 + 1, c1 - c0 + 1).cwiseAbs2().maxCoeff();
}

/// The strongest beat of the window with a harmonic; none: amplitude 0.
Beat strongest(const SampleWindow& window, const WindowSums& sums, const Harmonic& harmonic,
               const MoireSettings& settings) {
  const double reach = 1.0 / kFinestBeat, step = 0.5 / window.size;
  const int half = static_cast<int>(reach / step);
  const FrequencyRow fx{(harmonic.fx - half * step) * window.size, step * window.size, 2 * half + 1};
  const FrequencyRow fy{(harmonic.fy - half * step) * window.size, step * window.size, 2 * half + 1};
  const auto z = fourier_sums(window.x, window.y, window.area, fx, fy);
  Beat best;
  best.grating = harmonic.grating->name;
  best.order_x = harmonic.order_x;
  best.order_y = harmonic.order_y;
  for (int row = 0; row < fy.count; ++row) {
    for (int column = 0; column < fx.count; ++column) {
      const double power = std::norm(std::complex<double>(z(row, column)));
      if (power < kInStep * sums.area2 || !is_peak(z, row, column)) continue;
      const double dx = (column - half) * step, dy = (row - half) * step;
      const double f = std::hypot(harmonic.fx + dx, harmonic.fy + dy), beat = std::hypot(dx, dy);
      if (f < kSlowest || beat > reach) continue;
      const double amplitude = std::sqrt(power) / sums.area * disc_shape(f, sums.diameter);
      const double degree = settings.viewing_distance * std::tan(std::numbers::pi / 180.0);
      const double contrast = 2.0 * amplitude * harmonic.amplitude;
      const double seen = contrast * eye_sensitivity(beat * degree);
      if (seen <= best.seen) continue;
      best.period = beat > 0.0 ? 1.0 / beat : 1.0 / (0.5 * step);
      best.pattern_period = 1.0 / f;
      best.amplitude = amplitude;
      best.contrast = contrast;
      best.seen = seen;
      best.visible = seen > settings.threshold;
    }
  }
  return best;
}

}  // namespace

double eye_sensitivity(double f) {
  constexpr double kBest = 0.9808;  // near 8 cycles per degree
  return 2.6 * (0.0192 + 0.114 * f) * std::exp(-std::pow(0.114 * f, 1.1)) / kBest;
}

std::vector<Beat> find_beats(const DotStore& dots, const FreeArea& free, const std::vector<Grating>& gratings,
                             const MoireSettings& settings, int threads) {
  const auto harmonics = harmonics_of(gratings, settings);
  if (harmonics.empty()) return {};
  const RectangleZone& box = free.bounds();
  const double size = std::min({settings.window, box.x1 - box.x0, box.y1 - box.y0});
  std::vector<SampleWindow> windows;
  for (int k = 0; k < kSquares * kSquares; ++k) {
    const int column = k % kSquares, row = k / kSquares;
    const double x = box.x0 + (column + 0.5) / kSquares * (box.x1 - box.x0);
    const double y = box.y0 + (row + 0.5) / kSquares * (box.y1 - box.y0);
    windows.push_back(cut_window(dots, std::clamp(x - 0.5 * size, box.x0, box.x1 - size),
                                 std::clamp(y - 0.5 * size, box.y0, box.y1 - size), size));
  }
  std::erase_if(windows,
                [](const SampleWindow& window) { return static_cast<double>(window.x.size()) < 2.0 * kInStep; });
  std::vector<Beat> found(windows.size() * harmonics.size());
  core::run_batches(found.size(), threads, [&](std::size_t i) {
    const SampleWindow& window = windows[i / harmonics.size()];
    found[i] = strongest(window, sums_of(window), harmonics[i % harmonics.size()], settings);
  });
  std::vector<Beat> beats;
  for (std::size_t h = 0; h < harmonics.size(); ++h) {
    Beat best;
    for (std::size_t w = 0; w < windows.size(); ++w) {
      if (found[w * harmonics.size() + h].seen > best.seen) best = found[w * harmonics.size() + h];
    }
    if (best.seen > 0.0) beats.push_back(std::move(best));
  }
  std::stable_sort(beats.begin(), beats.end(), [](const Beat& a, const Beat& b) { return a.seen > b.seen; });
  return beats;
}

}  // namespace evenglow::design

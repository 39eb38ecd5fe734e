#include "tracer/films/symmetric_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

constexpr double kReach = 8.0;  ///< g is nothing beyond this many widths
/// Four-point Gauss-Legendre rule on [0, 1].
constexpr std::array<double, 4> kGaussAt{0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                         0.93056815579702629};
constexpr std::array<double, 4> kGaussWeight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                             0.17392742256872693};

/// g integrated over the azimuth of b' (|b'| = b), times b.
double ring(double b_in, double b, double s2) {
  const double d = b - b_in;
  return b / s2 * std::exp(-d * d / (2.0 * s2)) * scaled_bessel_i0(b_in * b / s2);
}

/// Points and weights of a composite rule on [0, 1], panels of about the lobe's width.
struct Quadrature {
  std::vector<double> at, weight;
  explicit Quadrature(double width) {
    const auto panels = static_cast<std::size_t>(std::clamp(std::ceil(1.5 / width), 16.0, 600.0));
    const double h = 1.0 / static_cast<double>(panels);
    for (std::size_t p = 0; p < panels; ++p) {
      for (std::size_t i = 0; i < 4; ++i) {
        at.push_back((static_cast<double>(p) + kGaussAt[i]) * h);
        weight.push_back(kGaussWeight[i] * h);
      }
    }
  }
  /// First and last point within reach of b.
  std::pair<std::size_t, std::size_t> near(double b, double reach) const {
    const auto first = std::lower_bound(at.begin(), at.end(), b - reach);
    const auto last = std::upper_bound(at.begin(), at.end(), b + reach);
    return {static_cast<std::size_t>(first - at.begin()), static_cast<std::size_t>(last - at.begin())};
  }
};

}  // namespace

double scaled_bessel_i0(double x) {
  if (x <= 3.75) {
    const double t = (x / 3.75) * (x / 3.75);
    return std::exp(-x) *
           (1.0 +
            t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813))))));
  }
  const double t = 3.75 / x;
  return (0.39894228 +
          t * (0.01328592 +
               t * (0.00225319 +
                    t * (-0.00157565 +
                         t * (0.00916281 +
                              t * (-0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))))) /
         std::sqrt(x);
}

SymmetricLobe::SymmetricLobe(double width) : width_(width) {
  core::expects(width >= 0.003 && width <= 2.0, "the width of a lobe lies in [0.003, 2]");
  const double s2 = width * width;
  const double reach = kReach * width;
  const Quadrature rule(width);
  const std::size_t n = rule.at.size();
  // Rows of the kernel, band only.
  std::vector<std::pair<std::size_t, std::size_t>> band(n);
  std::vector<std::vector<double>> kernel(n);
  for (std::size_t i = 0; i < n; ++i) {
    band[i] = rule.near(rule.at[i], reach);
    for (std::size_t j = band[i].first; j < band[i].second; ++j) {
      kernel[i].push_back(rule.weight[j] * ring(rule.at[i], rule.at[j], s2));
    }
  }
  std::vector<double> c(n, 1.0);
  std::vector<double> next(n);
  double change = 1.0;
  for (int step = 0; step < 200 && change > 1e-12; ++step) {
    change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = band[i].first; j < band[i].second; ++j) sum += kernel[i][j - band[i].first] * c[j];
      next[i] = std::sqrt(c[i] / sum);
      change = std::max(change, std::abs(next[i] / c[i] - 1.0));
    }
    c.swap(next);
  }
  const double intervals = std::clamp(std::ceil(16.0 / width), 128.0, 6000.0);
  inverse_step_ = intervals;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(intervals); ++i) {
    const double b = static_cast<double>(i) / intervals;
    const auto [first, last] = rule.near(b, reach);
    double sum = 0.0;
    for (std::size_t j = first; j < last; ++j) sum += rule.weight[j] * ring(b, rule.at[j], s2) * c[j];
    scaling_.push_back(1.0 / sum);
  }
  // Between the grid's points the cubic may pass its largest value by its own error.
  largest_ = *std::max_element(scaling_.begin(), scaling_.end()) * (1.0 + 1e-5);
  find_bounds();
}

/// From 32 points of each interval; between them c, which is smooth on the scale of the lobe's width, stays within what
/// it changes by over the whole interval.
void SymmetricLobe::find_bounds() {
  constexpr std::size_t kPoints = 32;
  for (std::size_t i = 0; i < kBounds; ++i) {
    double least = largest_, most = 0.0;
    for (std::size_t j = 0; j <= kPoints; ++j) {
      const double beta2 = (static_cast<double>(i) + static_cast<double>(j) / kPoints) / static_cast<double>(kBounds);
      const double c = scaling(std::sqrt(beta2));
      least = std::min(least, c);
      most = std::max(most, c);
    }
    const double slack = (most - least) / kPoints + 1e-6 * most;
    bounds_[i] = {static_cast<float>(least - slack), static_cast<float>(most + slack)};
  }
}

double SymmetricLobe::scaling(double beta) const {
  const std::size_t last = scaling_.size() - 1;
  const double x = std::clamp(beta, 0.0, 1.0) * inverse_step_;
  const std::size_t i = std::clamp(static_cast<std::size_t>(x), std::size_t{1}, last - 2);
  const double t = x - static_cast<double>(i);  // Lagrange through i - 1 ... i + 2
  return -t * (t - 1.0) * (t - 2.0) / 6.0 * scaling_[i - 1] + (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0 * scaling_[i] -
         (t + 1.0) * t * (t - 2.0) / 2.0 * scaling_[i + 1] + (t + 1.0) * t * (t - 1.0) / 6.0 * scaling_[i + 2];
}

double SymmetricLobe::value(double beta_in, double beta_out, double distance2) const {
  const double s2 = width_ * width_;
  return scaling(beta_in) * scaling(beta_out) * std::exp(-distance2 / (2.0 * s2)) / (2.0 * 3.141592653589793 * s2);
}

}  // namespace evenglow::tracer

#include "tracer/films/abg_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kReach = 2.0;          ///< two directions of one hemisphere are no further apart
constexpr std::size_t kIntervals = 96;  ///< of the nodes of c
constexpr std::size_t kTurnPanels = 3;  ///< panels of half a turn

/// Eight-point Gauss-Legendre rule on [0, 1].
constexpr std::array<double, 8> kGaussAt{0.019855071751231884, 0.10166676129318663, 0.2372337950418355,
                                         0.40828267875217511,  0.59171732124782489, 0.7627662049581645,
                                         0.89833323870681337,  0.98014492824876812};
constexpr std::array<double, 8> kGaussWeight{0.050614268145188130, 0.11119051722668724, 0.15685332293894364,
                                             0.18134189168918099,  0.18134189168918099, 0.15685332293894364,
                                             0.11119051722668724,  0.050614268145188130};

/// Weights of the cubic through the nodes first ... first + 3.
struct Stencil {
  std::size_t first = 0;
  std::array<double, 4> weight{};
};

Stencil stencil(double at) {
  const std::size_t i = std::clamp(static_cast<std::size_t>(at), std::size_t{1}, kIntervals - 2);
  const double t = at - static_cast<double>(i);
  return {i - 1,
          {-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0, -(t + 1.0) * t * (t - 2.0) / 2.0,
           (t + 1.0) * t * (t - 1.0) / 6.0}};
}

/// Borders of panels in the way d: fine within the lobe's width and on both sides of 1 - b, where the circle of radius
/// d about b begins to cross the horizon.
std::vector<double> panels(double width, double beta) {
  std::vector<double> borders{0.0, kReach};
  for (double d = 0.25 * width; d < kReach; d *= 1.6) borders.push_back(d);
  const double kink = 1.0 - beta;
  if (kink > 0.0) borders.push_back(kink);
  for (double step = 0.5 * std::max(kink, width); step > 0.02 * width && borders.size() < 80; step *= 0.4) {
    if (kink - step > 0.0) borders.push_back(kink - step);
    if (kink + step < kReach) borders.push_back(kink + step);
  }
  // The circle leaves the disk at 1 + b.
  borders.push_back(std::min(1.0 + beta, kReach));
  std::sort(borders.begin(), borders.end());
  return borders;
}

}  // namespace

AbgLobe::AbgLobe(double b, double g) : b_(b), g_(g), width_(std::pow(b, 1.0 / g)) {
  core::expects(g >= 0.5 && g <= 6.0 && width_ >= kLeastWidth * (1.0 - 1e-12) && width_ <= kLargestWidth,
                "an ABg lobe has g in [0.5, 6] and B^(1/g) in [0.001, 2]");
  // Envelope of the draws: 1 / B up to the width, d^-g beyond.
  const double inner = 0.5 * width_ * width_ / b_;
  const double power = 2.0 - g_;
  const double outer =
      std::abs(power) < 1e-9 ? std::log(kReach / width_) : (std::pow(kReach, power) - std::pow(width_, power)) / power;
  core_ = inner / (inner + outer);
  double sum = 0.0;
  const std::vector<double> borders = panels(width_, 1.0);
  for (std::size_t p = 0; p + 1 < borders.size(); ++p) {
    const double span = borders[p + 1] - borders[p];
    for (std::size_t i = 0; i < kGaussAt.size(); ++i) {
      const double d = borders[p] + kGaussAt[i] * span;
      sum += kGaussWeight[i] * span * d * shape(d);
    }
  }
  a_ = 1.0 / (2.0 * core::kPi * sum);
  scale_ = 0.2 * std::min(width_, 1.0);
  inverse_log_ = static_cast<double>(kIntervals) / std::log1p(1.0 / scale_);
  solve();
}

double AbgLobe::shape(double way) const {
  return 1.0 / (b_ + std::pow(way, g_));
}

/// Adds the integral of c over the part of the circle of radius `way` about beta that lies above the horizon, times
/// `ring`, to the weights of the nodes of c.
void AbgLobe::add_circle(double beta, double way, double ring, double* row) const {
  const double edge = beta > 0.0 ? (1.0 - beta * beta - way * way) / (2.0 * beta * way) : (way < 1.0 ? 1.0 : -1.0);
  // From the azimuth where the circle leaves the disk, or from 0, to 180 degrees; the other half is alike.
  const double open = core::kPi - std::acos(std::clamp(edge, -1.0, 1.0));
  for (std::size_t panel = 0; panel < kTurnPanels; ++panel) {
    // Panels grow from the border, where c is steepest: shares 0 ... 1/16 ... 1/4 ... 1.
    const double low = panel == 0 ? 0.0 : std::pow(0.25, static_cast<double>(kTurnPanels - panel));
    const double high = std::pow(0.25, static_cast<double>(kTurnPanels - panel - 1));
    for (std::size_t t = 0; t < kGaussAt.size(); ++t) {
      const double turn = core::kPi - open * (1.0 - (low + kGaussAt[t] * (high - low)));
      const double out = std::sqrt(std::max(0.0, beta * beta + way * way + 2.0 * beta * way * std::cos(turn)));
      const Stencil s = stencil(std::log1p(std::max(0.0, 1.0 - out) / scale_) * inverse_log_);
      const double weight = 2.0 * ring * open * (high - low) * kGaussWeight[t];
      for (std::size_t k = 0; k < 4; ++k) row[s.first + k] += weight * s.weight[k];
    }
  }
}

/// Row i: the integral of c h about the node i, linear in the nodes of c.
std::vector<double> AbgLobe::kernel() const {
  constexpr std::size_t n = kIntervals + 1;
  std::vector<double> rows(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double beta = std::max(0.0, 1.0 - scale_ * std::expm1(static_cast<double>(i) / inverse_log_));
    const std::vector<double> borders = panels(width_, beta);
    for (std::size_t p = 0; p + 1 < borders.size(); ++p) {
      const double span = borders[p + 1] - borders[p];
      if (span <= 0.0 || borders[p] >= 1.0 + beta) continue;
      for (std::size_t q = 0; q < kGaussAt.size(); ++q) {
        const double way = borders[p] + kGaussAt[q] * span;
        add_circle(beta, way, a_ * kGaussWeight[q] * span * way * shape(way), &rows[i * n]);
      }
    }
  }
  return rows;
}

void AbgLobe::solve() {
  constexpr std::size_t n = kIntervals + 1;
  const std::vector<double> rows = kernel();
  scaling_.assign(n, 1.0);
  std::vector<double> next(n);
  double change = 1.0;
  for (int step = 0; step < 300 && change > 1e-12; ++step) {
    change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      double integral = 0.0;
      for (std::size_t j = 0; j < n; ++j) integral += rows[i * n + j] * scaling_[j];
      next[i] = std::sqrt(scaling_[i] / integral);
      change = std::max(change, std::abs(next[i] / scaling_[i] - 1.0));
    }
    scaling_.swap(next);
  }
  // Between the nodes the cubic may pass its largest value by its own error.
  largest_ = *std::max_element(scaling_.begin(), scaling_.end()) * (1.0 + 1e-4);
}

double AbgLobe::scaling(double beta) const {
  const Stencil s = stencil(std::log1p(std::clamp(1.0 - beta, 0.0, 1.0) / scale_) * inverse_log_);
  double c = 0.0;
  for (std::size_t k = 0; k < 4; ++k) c += s.weight[k] * scaling_[s.first + k];
  return c;
}

double AbgLobe::value(double beta_in, double beta_out, double distance2) const {
  return scaling(beta_in) * scaling(beta_out) * a_ * shape(std::sqrt(distance2));
}

double AbgLobe::draw_way(core::PhotonRng& rng) const {
  while (true) {
    const double at = rng.uniform();
    const bool inner = at < core_;
    const double share = inner ? at / core_ : (at - core_) / (1.0 - core_);
    const double power = 2.0 - g_;
    double way = 0.0;
    if (inner) {
      way = width_ * std::sqrt(share);
    } else if (std::abs(power) < 1e-9) {
      way = width_ * std::pow(kReach / width_, share);
    } else {
      const double low = std::pow(width_, power);
      way = std::pow(low + share * (std::pow(kReach, power) - low), 1.0 / power);
    }
    // h over the envelope: at least one half.
    const double raised = std::pow(way, g_);
    if (rng.uniform() * (b_ + raised) < (inner ? b_ : raised)) return way;
  }
}

}  // namespace evenglow::tracer

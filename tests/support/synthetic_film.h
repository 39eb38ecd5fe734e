#pragma once

#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "core/base/units.h"
#include "core/light/mueller.h"
#include "tracer/polarized_bsdf/coherency.h"
#include "tracer/polarized_bsdf/diattenuator_fit.h"
#include "tracer/polarized_bsdf/mueller_fit.h"
#include "tracer/polarized_bsdf/polarizer.h"

namespace evenglow::tests {

/// Mean and standard deviation of (estimate - truth) / standard error.
class Pulls {
 public:
  void add(double estimate, double truth, double se) {
    const double pull = (estimate - truth) / se;
    ++count_;
    sum_ += pull;
    squares_ += pull * pull;
  }
  double count() const { return count_; }
  double mean() const { return sum_ / count_; }
  double width() const { return std::sqrt(squares_ / count_ - mean() * mean()); }

 private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

/// Readings behind linear polarizers at `angles` (rad) of a film with first row 1/2 (S, -X, -Y), without noise.
inline std::vector<tracer::AngleReading> angle_readings(double tau_min, double tau_max, double delta,
                                                        const std::vector<double>& angles, double contrast = 1.0) {
  std::vector<tracer::AngleReading> readings;
  for (const double a : angles) {
    const double value = 0.5 * (tau_max + tau_min - contrast * (tau_max - tau_min) * std::cos(2.0 * (a - delta)));
    readings.push_back({a, value, 1.0});
  }
  return readings;
}

inline const std::vector<double>& four_angles() {
  static const std::vector<double> angles{0.0, core::kPi / 4, core::kPi / 2, 3 * core::kPi / 4};
  return angles;
}

/// Readings of M with every pair of 0, 45, 90, 135 degrees, right, left in illumination and observation (36), or of
/// 0, 60, 120 degrees and right (16). Without noise, error 1.
inline std::vector<tracer::MuellerReading> mueller_readings(const core::MuellerMatrix& M, bool many) {
  using tracer::PolarizerKind;
  struct State {
    PolarizerKind kind;
    double degrees;
  };
  const std::vector<State> states =
      many ? std::vector<State>{{PolarizerKind::linear, 0},   {PolarizerKind::linear, 45}, {PolarizerKind::linear, 90},
                                {PolarizerKind::linear, 135}, {PolarizerKind::right, 0},   {PolarizerKind::left, 0}}
           : std::vector<State>{{PolarizerKind::linear, 0},
                                {PolarizerKind::linear, 60},
                                {PolarizerKind::linear, 120},
                                {PolarizerKind::right, 0}};
  std::vector<tracer::MuellerReading> readings;
  for (const State& in : states) {
    for (const State& out : states) {
      tracer::MuellerReading r;
      r.in = tracer::polarization_of(in.kind, in.degrees * core::kRadPerDeg, 1.0, 1.0);
      r.out = tracer::analyzer_of(out.kind, out.degrees * core::kRadPerDeg, {}, 1.0);
      r.value = r.out.dot(M * r.in);
      readings.push_back(r);
    }
  }
  return readings;
}

template <typename Reading>
void add_noise(std::vector<Reading>& readings, double se, std::mt19937_64& rng) {
  std::normal_distribution<double> normal(0.0, se);
  for (Reading& r : readings) {
    r.value += normal(rng);
    r.se = se;
  }
}

/// A random physical matrix with M00 = 1: coherency matrix of `rank` random vectors, mixed with the share `depolarized`
/// of the ideal depolarizer (its eigenvalues are then at least a quarter of that share).
inline core::MuellerMatrix random_physical(int rank, double depolarized, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  tracer::CoherencyMatrix H = tracer::CoherencyMatrix::Zero();
  for (int r = 0; r < rank; ++r) {
    Eigen::Vector4cd v;
    for (int i = 0; i < 4; ++i) v[i] = {normal(rng), normal(rng)};
    H += v * v.adjoint();
  }
  H *= (1.0 - depolarized) / H.trace().real();
  H += 0.25 * depolarized * tracer::CoherencyMatrix::Identity();
  return tracer::mueller_matrix(H);
}

}  // namespace evenglow::tests

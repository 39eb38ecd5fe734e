#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tracer/polarized_bsdf/lobe_fit.h"
#include "tracer/polarized_bsdf/lobe_luminance.h"

/// The least-squares problem of `fit_lobes` and its solution. Inner part of that room.
namespace evenglow::tracer {

/// What is fitted: logarithms of what must be positive, then the offsets. a1 and b1 follow from the energy.
inline constexpr int kLobeLogs = 18, kLobeFree = 20, kLobeThroughput = 17;
using LobeFree = std::array<double, kLobeFree>;

template <typename T>
using LobeMember = T LobeValues<T>::*;

/// The positive ones, in the order of the fit.
template <typename T>
const std::array<LobeMember<T>, kLobeLogs>& lobe_logs() {
  using V = LobeValues<T>;
  static const std::array<LobeMember<T>, kLobeLogs> members{&V::sx, &V::sy, &V::s2,  &V::s3p, &V::s3b, &V::p1,
                                                            &V::p3, &V::b2, &V::b3,  &V::t1,  &V::t2,  &V::t3,
                                                            &V::a2, &V::a3, &V::a2b, &V::a3b, &V::e0,  &V::throughput};
  return members;
}

inline constexpr std::array<const char*, kLobeFree> kLobeNames{"sx",
                                                               "sy",
                                                               "s2",
                                                               "s3p",
                                                               "s3b",
                                                               "p1_cd_m2",
                                                               "p3_cd_m2",
                                                               "b2_cd_m2",
                                                               "b3_cd_m2",
                                                               "t1",
                                                               "t2",
                                                               "t3",
                                                               "a2_pass_cd_m2",
                                                               "a3_pass_cd_m2",
                                                               "a2_block_cd_m2",
                                                               "a3_block_cd_m2",
                                                               "e0_lx",
                                                               "throughput",
                                                               "offset_reflection_deg",
                                                               "offset_transmission_deg"};

template <typename T>
LobeValues<T> lobe_values(const T* x, double absorption) {
  using std::exp;
  LobeValues<T> v;
  for (std::size_t i = 0; i < kLobeLogs; ++i) v.*lobe_logs<T>()[i] = exp(x[i]);
  v.offset_reflection = x[kLobeLogs];
  v.offset_transmission = x[kLobeLogs + 1];
  constrain_energy(v, absorption);
  return v;
}

/// One reading with its assumed error.
struct LobeReading {
  ScatterKind kind;
  LuminanceRow row;
  double error;  ///< cd/m2
};
std::vector<LobeReading> lobe_readings(const LuminanceTable& reflection, const LuminanceTable& transmission,
                                       const LobeFitOptions& options);

LobeValues<double> to_values(const LobeParameters& parameters, const LuminanceSetup& setup);

/// The start of the options with amplitudes and e0 that fit the sum of the readings.
LobeFree lobe_start(const std::vector<LobeReading>& readings, const LobeFitOptions& options);

struct LobeSolution {
  LobeFree x{};
  Eigen::MatrixXd jacobian;  ///< residuals (in errors) x kLobeFree
  double chi_square = 0.0;   ///< without the loss
  double scatter = 1.0;      ///< factor of (J^T J)^-1 that makes it the covariance
  int iterations = 0;
  bool converged = false;
};
/// Throws `core::Error` if no step keeps the energy constraint.
LobeSolution solve_lobes(const std::vector<LobeReading>& readings, const LobeFree& start,
                         const LobeFitOptions& options);

}  // namespace evenglow::tracer

#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace evenglow::tracer {

/// Nodes of incidence of a `SampledBsdf`: psi equally spaced over 180 degrees, sigma from 0 to nearly grazing, closer
/// where films change faster. Between nodes linear in psi and in sin^2 sigma; held beyond the last sigma.
class IncidenceGrid {
 public:
  IncidenceGrid();

  static constexpr std::size_t kPsi = 12;
  static constexpr std::size_t kSigma = 24;
  std::size_t size() const { return kPsi * cos2_.size(); }
  double psi(std::size_t node) const;    ///< rad
  double sigma(std::size_t node) const;  ///< rad
  std::size_t sigma_index(std::size_t node) const { return node % cos2_.size(); }
  /// The node of 180 degrees - psi.
  std::size_t mirrored(std::size_t node) const {
    return (kPsi - node / cos2_.size()) % kPsi * cos2_.size() + sigma_index(node);
  }
  double sin_sigma(std::size_t node) const { return sin_[node % cos2_.size()]; }
  double cos2_sigma(std::size_t node) const { return cos2_[node % cos2_.size()]; }
  const std::vector<double>& sigmas() const { return sigma_; }  ///< rad, ascending

  /// psi (rad in [0, pi)) of an axis at (cos_psi, sin_psi): the psi node before it and the share of the way to the
  /// next. The way is counted by the sines to both, which is within 0.02 degrees of the angle and needs no arc tangent.
  double psi_of(double cos_psi, double sin_psi) const;

  struct Cell {
    std::array<std::size_t, 4> node{};
    std::array<double, 4> weight{};  ///< >= 0, sum 1
  };
  /// The four nodes around an incidence; `psi` in [0, pi), `cos2` = cos^2 sigma.
  Cell cell(double psi, double cos2) const;

  /// One of those nodes, with the odds of its weight, for a uniform number in (0, 1).
  std::size_t draw(double psi, double cos2, double uniform) const;

 private:
  struct Place {
    std::size_t psi0, psi1, sigma0, sigma1;
    double psi_share, sigma_share;  ///< of psi1 and of sigma1
  };
  Place place(double psi, double cos2) const;
  std::size_t index(std::size_t psi, std::size_t sigma) const { return psi * cos2_.size() + sigma; }

  std::vector<double> sigma_, sin_, cos2_;
  std::array<double, kPsi + 1> cos_psi_{}, sin_psi_{};  ///< of the psi nodes, and of 180 degrees
  std::array<float, kSigma> steps_{};                   ///< cos2_ for the search: half the memory and twice the lanes
  std::vector<double> inverse_;                         ///< 1 / (cos2_[i] - cos2_[i + 1])
};

}  // namespace evenglow::tracer

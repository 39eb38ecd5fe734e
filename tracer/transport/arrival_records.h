#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include <Eigen/Core>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "core/parallel/ranks.h"
#include "tracer/scene/density_field.h"
#include "tracer/transport/arrival_log.h"

namespace evenglow::tracer {

/// Luminance that records give at some density.
struct Reweighted {
  core::Tally luminance;      ///< the unit of a trace of `photons` photons: scores, 1/sr
  std::uint64_t photons = 0;  ///< recorded
  double effective_share =
      0.0;  ///< (sum W)^2 / (n sum W^2), W the weight of a history at its last deposit; 1: as traced
};

/// Directions in ln density, of which few reach a cell: the parts of the directions at each cell of the density.
struct DirectionSet {
  struct Part {
    std::uint32_t direction = 0;
    float weight = 0.0F;  ///< 0: none
  };
  std::size_t count = 0;
  std::vector<std::array<Part, 4>> of_cell;
};

/// A Jacobian, rows x directions, with the variance of each entry from the batches.
struct RecordedSlopes {
  Eigen::MatrixXd mean, variance;
};

/// Histories of the photons of one trace, kept so that the luminance at another density needs no new photons
/// (importance sampling: Kahn and Marshall, J. Oper. Res. Soc. Am. 1 (1953) 263).
///
/// A history traced at the density r has at r' the weight W = product over its arrivals at the pattern of r'/r where it
/// met the microstructure and (1 - r')/(1 - r) where it did not; a deposit counts W times, as far as W goes before it,
/// and by r'/r more if it was in proportion to the density, by (1 - r')/(1 - r) for each bare place of the face that it
/// went through. Nothing else in a trace depends on the density, so that this is exact in expectation wherever
/// 0 < r < 1. Where r is 0 or 1 the other outcome was never seen: the factor is then 1.
class ArrivalRecords {
 public:
  /// The logs of batches traced at `density`, for a display with `bins` cells. Where ranks share the batches (`ranks`
  /// not null, and living longer), each keeps the logs of those that it traced and re-weights them; the sums are
  /// exchanged, so that every rank must ask for the same things in the same order. `stop` shortens the waiting for a
  /// lost rank.
  ArrivalRecords(const DensityField& density, std::size_t bins, int threads, std::vector<ArrivalLog> logs,
                 core::RankGroup* ranks = nullptr, std::stop_token stop = {});

  /// At the density `density`, on the same cells. Error for others.
  Reweighted at(const DensityField& density) const;
  /// d/de of the luminance at density exp(e direction), batch by batch (score function; Rubinstein and Shapiro 1993):
  /// each deposit times the sum of direction over what met, less direction r/(1 - r) over what passed.
  core::Tally derivative(const DensityField& density, const core::CellField& direction) const;

  /// For a weighted sum S = sum_i weights_i L_i of the luminance (the unit of `at`), dS/d ln density of every cell at
  /// once: the events of each history backwards, each arrival with the light that came after it.
  core::CellField gradient(const DensityField& density, const std::vector<double>& weights) const;
  /// d L_row / d e of the luminance summed over rows of bins at density exp(sum_j e_j direction_j).
  RecordedSlopes jacobian(const DensityField& density, const DirectionSet& directions,
                          const std::vector<std::uint32_t>& row_of_bin, std::size_t rows) const;

  const DensityField& density() const { return density_; }
  std::uint64_t photons() const { return photons_; }
  std::size_t bytes() const { return bytes_; }  ///< at all ranks

 private:
  /// Batches hold slightly different numbers of photons: all count as one of the mean number.
  double batch_scale(std::size_t batch) const;
  /// `sum_of(batch)` of each batch, by the rank that holds it.
  std::vector<std::vector<double>> of_batches(const std::function<std::vector<double>(std::size_t)>& sum_of) const;

  DensityField density_;
  std::size_t bins_;
  int threads_;
  core::RankGroup* ranks_;
  std::stop_token stop_;
  std::uint64_t photons_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::size_t> own_;  ///< batches whose words are here
  std::vector<std::uint64_t> batch_photons_;
  std::vector<std::vector<std::uint32_t>> words_;  ///< of each batch of `own_`
};

}  // namespace evenglow::tracer

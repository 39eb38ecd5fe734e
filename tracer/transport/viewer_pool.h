#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/montecarlo/photon_rng.h"
#include "tracer/transport/viewer_subpath.h"

namespace evenglow::tracer {

/// Subpaths from the viewer of one wavelength band, drawn anew now and then and shared by the scatters in between. Each
/// batch of photons has pools of its own, so that the batches stay independent.
class ViewerPool {
 public:
  ViewerPool(std::size_t levels, const core::PhotonRng& rng)
      : arrivals_(levels), cursors_(2 * levels, 0), joins_(2 * levels, 2), rng_(rng) {}

  const ViewerArrivals& arrivals() const { return arrivals_; }
  std::size_t subpaths() const { return subpaths_; }
  core::PhotonRng& rng() { return rng_; }

  /// Has the pool served its time, so many scatters? Counts one, or one part of one.
  bool spent(std::size_t part, std::size_t scatters) {
    used_ += 1.0 / static_cast<double>(part);
    return used_ > static_cast<double>(scatters) || subpaths_ == 0;
  }
  /// The pool now holds so many new subpaths.
  void renewed(std::size_t subpaths);
  /// Next arrival of a list (`ViewerArrivals::list`) that is not empty: in turn, from a random one on, so that each is
  /// as likely.
  const ViewerArrival& next(std::size_t list) {
    const auto& all = arrivals_.lists[list];
    std::size_t& cursor = cursors_[list];
    if (cursor >= all.size()) cursor = 0;
    return all[cursor++];
  }
  ViewerArrivals& refill() { return arrivals_; }
  /// To how many arrivals of a list a scatter is joined.
  std::size_t joins(std::size_t list) const { return joins_[list]; }
  void set_joins(std::size_t list, std::size_t joins) { joins_[list] = joins; }

 private:
  ViewerArrivals arrivals_;
  std::vector<std::size_t> cursors_, joins_;  ///< of each list
  std::size_t subpaths_ = 0;
  double used_ = 0.0;
  core::PhotonRng rng_;
};

/// The pools of one batch, made when they are first asked for.
class ViewerPools {
 public:
  /// Numbers for the pools from those of the batch: its key, moved to a stream of its own, and its first photon.
  void seed(const core::RandomKey& key, std::uint64_t first_photon);
  ViewerPool& of_band(std::size_t band, std::size_t levels);

 private:
  core::RandomKey key_{};
  std::uint64_t first_photon_ = 0;
  std::vector<std::unique_ptr<ViewerPool>> pools_;
};

}  // namespace evenglow::tracer

#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tracer/transport/arrival_log.h"
#include "tracer/transport/planar_history.h"

namespace evenglow::tracer {

/// Takes down each arrival at the pattern that the walk in the plate comes by.
struct RecordingObserver {
  static constexpr bool kActive = true;
  ArrivalLog* log = nullptr;

  void arrive(std::size_t cell, bool met) const { log->arrival(cell, met); }
};
extern template class BasicPlanarHistory<MeridianLight, RecordingObserver>;

/// The planar path; photons that are recorded take an instance of their own, so that others do not pay for it.
class PlanarRecordingHistory {
 public:
  PlanarRecordingHistory(const Scene& scene, const PlanarScene& layout, const DensityField& density)
      : plain_(scene, layout, density), recording_(scene, layout, density) {}

  void run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums) const {
    if (sums.log == nullptr) {
      plain_.run(key, photon_index, sums);
      return;
    }
    RecordingObserver observer{sums.log};
    recording_.run(key, photon_index, sums, observer);
  }

 private:
  PlanarHistory plain_;
  BasicPlanarHistory<MeridianLight, RecordingObserver> recording_;
};

/// `History` with the first photons of each batch recorded, as many as fit its share of the memory. The numbers of the
/// trace are the same as without.
template <typename History>
class RecordingHistory {
 public:
  RecordingHistory(const History& history, std::uint64_t batch_photons, std::size_t batches, std::size_t bytes)
      : history_(history), batch_photons_(batch_photons), logs_(batches, ArrivalLog(bytes / batches)) {}

  void run(const core::RandomKey& key, std::uint64_t photon_index, BatchSums& sums) const {
    ArrivalLog& log = logs_[photon_index / batch_photons_];
    if (!log.has_room()) {
      history_.run(key, photon_index, sums);
      return;
    }
    if (log.empty()) log.reserve();
    sums.log = &log;
    history_.run(key, photon_index, sums);
    log.end_photon();
    sums.log = nullptr;
  }

  /// Of all batches, in their order.
  std::vector<ArrivalLog> take_logs() { return std::move(logs_); }

 private:
  const History& history_;
  std::uint64_t batch_photons_;
  mutable std::vector<ArrivalLog> logs_;  ///< each is written by its own batch alone
};

}  // namespace evenglow::tracer

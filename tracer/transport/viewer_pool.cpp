#include "tracer/transport/viewer_pool.h"

namespace evenglow::tracer {
namespace {

constexpr std::uint32_t kViewerStreams = 0x80000000U;  // variants of a run are far fewer
constexpr int kBandShift = 56;                         // photons of a run are at most 1e12

}  // namespace

void ViewerPool::renewed(std::size_t subpaths) {
  subpaths_ = subpaths;
  used_ = 0.0;
  for (std::size_t list = 0; list < cursors_.size(); ++list) {
    cursors_[list] = static_cast<std::size_t>(rng_.uniform() * static_cast<double>(arrivals_.lists[list].size()));
  }
}

void ViewerPools::seed(const core::RandomKey& key, std::uint64_t first_photon) {
  key_ = key;
  key_.stream ^= kViewerStreams;
  first_photon_ = first_photon;
  pools_.clear();
}

ViewerPool& ViewerPools::of_band(std::size_t band, std::size_t levels) {
  if (band >= pools_.size()) pools_.resize(band + 1);
  if (!pools_[band]) {
    const std::uint64_t index = first_photon_ + (static_cast<std::uint64_t>(band) << kBandShift);
    pools_[band] = std::make_unique<ViewerPool>(levels, core::PhotonRng(key_, index));
  }
  return *pools_[band];
}

}  // namespace evenglow::tracer

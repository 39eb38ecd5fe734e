#pragma once

#include <cstdint>

#include <Random123/philox.h>

namespace evenglow::core {

/// Which random numbers a trace uses: every photon's numbers depend on these and on its index alone.
struct RandomKey {
  std::uint64_t seed = 1;    ///< of the run
  std::uint32_t stream = 0;  ///< tells apart the variants of one run
  std::uint32_t step = 0;    ///< tells apart the traces of one design
};

/// Counter-based random numbers of one photon: Philox4x64-10 (Salmon et al., SC11), keyed by `RandomKey`, counted by
/// photon index and draw. Period 2^64 draws a photon.
class PhotonRng {
 public:
  PhotonRng(const RandomKey& key, std::uint64_t photon_index)
      : counter_{{0, photon_index, 0, 0}},
        key_{{key.seed, (static_cast<std::uint64_t>(key.stream) << 32) | key.step}} {}

  /// Uniform in the open interval (0, 1), 53 bits.
  double uniform() {
    if (used_ == 4) refill();
    return (static_cast<double>(block_[used_++] >> 11) + 0.5) * 0x1.0p-53;
  }

 private:
  void refill() {
    block_ = r123::Philox4x64()(counter_, key_);
    ++counter_[0];
    used_ = 0;
  }

  r123::Philox4x64::ctr_type counter_;
  r123::Philox4x64::key_type key_;
  r123::Philox4x64::ctr_type block_{};
  unsigned used_ = 4;
};

}  // namespace evenglow::core

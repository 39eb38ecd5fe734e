#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include <Random123/philox.h>

namespace evenglow::core {

/// Which random numbers a trace uses: every photon's numbers depend on these and on its index alone.
struct RandomKey {
  std::uint64_t seed = 1;    ///< of the run
  std::uint32_t stream = 0;  ///< tells apart the variants of one run
  std::uint32_t step = 0;    ///< tells apart the traces of one design
};

/// Random numbers of one photon: xoshiro256+ (Blackman & Vigna, ACM Trans. Math. Softw. 47, 2021; made for numbers in
/// the unit interval), its state drawn by Philox4x64-10 (Salmon et al., SC11), keyed by `RandomKey`, counted by photon
/// index. So a photon's numbers can be had anywhere at any time, and each costs a few additions. Period 2^256 - 1; that
/// the numbers of two of 1e12 photons overlap has odds below 1e-40.
class PhotonRng {
 public:
  PhotonRng(const RandomKey& key, std::uint64_t photon_index) {
    const r123::Philox4x64::key_type philox_key{{key.seed, (static_cast<std::uint64_t>(key.stream) << 32) | key.step}};
    const auto block = r123::Philox4x64()(r123::Philox4x64::ctr_type{{0, photon_index, 0, 0}}, philox_key);
    for (unsigned i = 0; i < 4; ++i) state_[i] = block[i];
    state_[0] |= static_cast<std::uint64_t>((state_[0] | state_[1] | state_[2] | state_[3]) == 0);  // 0 would stay 0
  }

  /// Uniform in the open interval (0, 1), 53 bits.
  double uniform() { return (static_cast<double>(next() >> 11) + 0.5) * 0x1.0p-53; }

 private:
  std::uint64_t next() {
    const std::uint64_t result = state_[0] + state_[3];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  std::array<std::uint64_t, 4> state_;
};

/// Four words for a photon's second generator, of 32 bits: by Philox4x32-10, another function of the same key and index.
inline std::array<std::uint32_t, 4> lane_words(const RandomKey& key, std::uint64_t photon_index) {
  const r123::Philox4x32::key_type philox_key{
      {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)}};
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(photon_index),
                                            static_cast<std::uint32_t>(photon_index >> 32), key.stream, key.step}};
  const auto block = r123::Philox4x32()(counter, philox_key);
  const std::uint32_t one = (block[0] | block[1] | block[2] | block[3]) == 0 ? 1U : 0U;  // 0 would stay 0
  return {block[0] | one, block[1], block[2], block[3]};
}

}  // namespace evenglow::core

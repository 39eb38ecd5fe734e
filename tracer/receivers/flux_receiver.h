#pragma once

#include <string>
#include <vector>

#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// Why a photon was given up.
enum class LossReason {
  kLeak,    ///< no surface where its body must have one
  kStuck,   ///< more events than any real path has
  kInvalid  ///< a number that is not one
};
inline constexpr int kLossReasons = 3;

/// The energy account. Every photon ends in exactly one bin: a side that it leaves by, a part that absorbs it, or a
/// reason of loss; so the shares sum to 1 exactly.
class FluxReceiver final : public Receiver {
 public:
  explicit FluxReceiver(std::vector<std::string> parts) : parts_(std::move(parts)) {}

  std::size_t bins() const override { return kSides + parts_.size() + kLossReasons; }
  std::optional<Score> score(const Crossing& crossing) const override {
    return Score{static_cast<std::size_t>(crossing.side), 1.0};
  }
  std::size_t absorbed_bin(int part) const { return kSides + static_cast<std::size_t>(part); }
  std::size_t lost_bin(LossReason reason) const { return kSides + parts_.size() + static_cast<std::size_t>(reason); }
  const std::vector<std::string>& parts() const { return parts_; }

 private:
  std::vector<std::string> parts_;
};

}  // namespace evenglow::tracer

#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "tracer/transport/arrival_factors.h"
#include "tracer/transport/arrival_log.h"

namespace evenglow::tracer {

/// Reads the words that an ArrivalLog wrote and tells `visitor` of each event in order: `arrive(cell, met)`,
/// `cross(cell)`, `share(cell)`, `deposit(bin, amount, shared)`, `end_photon()`.
template <typename Visitor>
void replay(const std::vector<std::uint32_t>& words, Visitor& visitor) {
  const std::uint32_t* const end = words.data() + words.size();
  for (const std::uint32_t* at = words.data(); at != end; ++at) {
    const std::uint32_t index = *at & ArrivalLog::kMostIndex;
    switch (const LogKind kind = ArrivalLog::kind(*at)) {
      case LogKind::kPassed:
      case LogKind::kMet:
        visitor.arrive(index, kind == LogKind::kMet);
        break;
      case LogKind::kCrossed:
        visitor.cross(index);
        break;
      case LogKind::kShare:
        visitor.share(index);
        break;
      case LogKind::kDeposit:
      case LogKind::kShared:
        visitor.deposit(index, static_cast<double>(std::bit_cast<float>(*++at)), kind == LogKind::kShared);
        break;
      case LogKind::kPhotonEnd:
        visitor.end_photon();
        break;
    }
  }
}

/// What a history is worth at another density than the one it was traced at (ArrivalRecords tells the formula), as far
/// as it has been replayed.
class HistoryWeight {
 public:
  explicit HistoryWeight(const ArrivalFactors& factors) : factors_(factors) {}

  void arrive(std::uint32_t cell, bool met) { arrivals_ *= met ? factors_.met[cell] : factors_.passed[cell]; }
  void cross(std::uint32_t cell) { crossed_ *= factors_.passed[cell]; }
  void share(std::uint32_t cell) { share_ = factors_.met[cell]; }
  /// Of the next deposit; the crossings before it are used up.
  double of_deposit(bool shared) {
    const double weight = arrivals_ * crossed_ * (shared ? share_ : 1.0);
    crossed_ = 1.0;
    return weight;
  }
  void end_photon() { arrivals_ = crossed_ = share_ = 1.0; }

  /// Of the arrivals alone.
  double of_arrivals() const { return arrivals_; }

 private:
  const ArrivalFactors& factors_;
  double arrivals_ = 1.0, crossed_ = 1.0, share_ = 1.0;
};

}  // namespace evenglow::tracer

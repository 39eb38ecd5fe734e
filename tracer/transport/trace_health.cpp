#include "tracer/transport/trace_health.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"

namespace evenglow::tracer {
namespace {

constexpr double kLostAllowed = 1e-6;
constexpr double kLostAlwaysAllowed = 10.0;
constexpr double kRounding = 1e-9;

class HealthCheck {
 public:
  HealthCheck(const Scene& scene, const TraceResult& result, const TraceOptions& options, const PhotonReplay& replay)
      : scene_(scene), result_(result), options_(options), replay_(replay) {}

  void sums() const {
    check_sums(result_.energy, &BatchSums::energy, "the energy account");
    check_sums(result_.luminance, &BatchSums::luminance, "the luminance");
    check_sums(result_.color_x, &BatchSums::color_x, "the color");
    check_sums(result_.color_z, &BatchSums::color_z, "the color");
    check_sums(result_.angular, &BatchSums::angular, "the directions");
  }

  void lost() const {
    static constexpr const char* kReasons[] = {"leaked", "stuck", "invalid"};
    double lost = 0.0;
    std::string text;
    for (int i = 0; i < kLossReasons; ++i) {
      const double count = result_.energy.total(lost_bin(i)).value;
      lost += count;
      text += fmt::format("{}{} {}", i > 0 ? ", " : "", count, kReasons[i]);
    }
    const std::size_t invalid = lost_bin(static_cast<int>(LossReason::kInvalid));
    if (result_.energy.total(invalid).value > 0.0) {
      throw core::Error("the light of a photon became a number that is none (" + text + ")" + first_rise({invalid}));
    }
    if (lost <= kLostAlwaysAllowed || lost <= kLostAllowed * static_cast<double>(result_.photons)) return;
    std::vector<std::size_t> bins;
    bins.reserve(kLossReasons);
    for (int i = 0; i < kLossReasons; ++i) bins.push_back(lost_bin(i));
    throw core::Error(
        fmt::format("too many photons were lost: {} of {} ({}){}", lost, result_.photons, text, first_rise(bins)));
  }

 private:
  using Bins = std::vector<double> BatchSums::*;

  std::size_t lost_bin(int reason) const { return scene_.energy.lost_bin(static_cast<LossReason>(reason)); }

  void check_sums(const core::Tally& tally, Bins bins, const char* what) const {
    for (std::size_t batch = 0; batch < tally.batches(); ++batch) {
      const std::vector<double>& sums = tally.batch(batch);
      const double largest = sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
      for (std::size_t bin = 0; bin < sums.size(); ++bin) {
        if (std::isfinite(sums[bin]) && sums[bin] >= -kRounding * std::max(largest, 0.0)) continue;
        const auto is_bad = [&](double before, double after) {
          return !std::isfinite(after) || after < before - kRounding * std::max(largest, 0.0);
        };
        const auto photon = first_photon(
            batch, [&](const BatchSums& s) { return (s.*bins)[bin]; }, is_bad);
        throw core::Error(fmt::format("{} holds {}: a power must be a number and not negative{}", what, sums[bin],
                                      photon_text(photon)));
      }
    }
  }

  /// The first photon by which one of these bins of the energy account grew, in words.
  std::string first_rise(const std::vector<std::size_t>& bins) const {
    const auto sum_of = [&](const std::vector<double>& energy) {
      double sum = 0.0;
      for (const std::size_t bin : bins) sum += energy[bin];
      return sum;
    };
    std::size_t batch = 0;
    while (batch + 1 < result_.energy.batches() && !(sum_of(result_.energy.batch(batch)) > 0.0)) ++batch;
    return photon_text(first_photon(
        batch, [&](const BatchSums& sums) { return sum_of(sums.energy); },
        [](double before, double after) { return after > before; }));
  }

  template <typename Value, typename IsBad>
  std::optional<std::uint64_t> first_photon(std::size_t batch, const Value& value, const IsBad& is_bad) const {
    const core::BatchRange range = core::batch_range(batch, options_.batches, options_.photons);
    BatchSums sums(scene_);
    sums.viewer.seed(options_.key, range.first);
    for (std::uint64_t i = 0; i < range.count; ++i) {
      if (options_.stop.stop_requested()) return std::nullopt;
      const double before = value(sums);
      replay_(range.first + i, sums);
      if (is_bad(before, value(sums))) return range.first + i;
    }
    return std::nullopt;
  }

  std::string photon_text(std::optional<std::uint64_t> photon) const {
    const core::RandomKey& key = options_.key;
    if (!photon) return fmt::format(", in step {}", key.step);
    return fmt::format(
        "; the first is photon {} of step {}: `evenglow trace RUN.yaml --seed {} --photon {} --step {} --stream {}` "
        "shows its way",
        *photon, key.step, key.seed, *photon, key.step, key.stream);
  }

  const Scene& scene_;
  const TraceResult& result_;
  const TraceOptions& options_;
  const PhotonReplay& replay_;
};

}  // namespace

void check_health(const Scene& scene, const TraceResult& result, const TraceOptions& options,
                  const PhotonReplay& replay) {
  const HealthCheck check(scene, result, options, replay);
  check.sums();
  check.lost();
}

}  // namespace evenglow::tracer

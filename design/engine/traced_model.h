#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

#include "design/problem/design_state.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/tracer.h"

namespace evenglow::design {

/// How a traced model runs.
struct TracedModelOptions {
  std::uint64_t seed = 1;
  std::uint32_t stream = 0;  ///< number of the variant
  std::size_t batches = 100;
  int threads = 0;
  std::stop_token stop{};
  tracer::TracePath path = tracer::TracePath::kAuto;
  std::size_t record_bytes = std::size_t{128} << 20;  ///< for the histories of a trace, where they are asked for
  core::RankGroup* ranks = nullptr;                   ///< that share each trace; null: this process alone
  /// Photons done of those of this trace.
  std::function<void(std::uint64_t done, std::uint64_t all)> progress{};
};

/// The forward model that traces photons; keeps a reference to the scene.
ForwardModel traced_model(const tracer::Scene& scene, TracedModelOptions options);

/// What a finished trace shows, in the units of the reports.
Observation make_observation(const tracer::Scene& scene, const tracer::TraceResult& result);

/// Every photon ends in one bin, so the energy account holds as many as were sent, but for rounding (1e-9); where they
/// carry different luminous flux, as many but for chance (the flux of a photon is 1 on average): 20 standard errors.
bool energy_adds_up(const core::Estimate& sum, std::uint64_t photons, bool flux_varies);

/// The step number of the trace that judges a finished design: no design step has it.
inline constexpr std::uint32_t kJudgingStep = 0xFFFFFFFFU;

}  // namespace evenglow::design

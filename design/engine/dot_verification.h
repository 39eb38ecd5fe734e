#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>

#include "design/dots/dot_spec.h"
#include "design/dots/keep_out.h"
#include "design/dots/placement.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/dots_judgment.h"
#include "design/problem/judgment.h"

/// The proof of a design by its real dots, and the correction of what they do otherwise than the density.
namespace evenglow::design {

/// What it works on.
struct DotVerification {
  const ForwardModel& model;
  const DesignSpec& spec;
  const DotSpec& dots;
  RectangleZone face;  ///< mm
  FreeArea free;
  double fill = 1.0;  ///< share of the patterned area under footprints
  std::uint64_t photons = 0;
  int threads = 0;
  std::stop_token stop{};  ///< for the placement; the traces have that of the model
};

struct VerifiedDots {
  DotsJudgment judgment;
  Placement placement;  ///< the chosen one
};

/// Told what comes next: of a round its number, of the judging trace -1; and of each finished round.
struct VerificationHooks {
  std::function<void(int round)> begins;
  std::function<void(const DotsRound&)> finished;
};

/// Places the dots of `designed`, traces them one by one, and corrects the density by the ratio of target and
/// luminance, noise taken out as by the updater ratio_noise_aware, up to `verify_rounds` times: until the rule of
/// `run_design` counts the dots as even enough, or a correction has gained less than 5 %. Dots of one size are placed
/// anew for each density. Others stay where the first round has placed them and get the sizes with which each cell of
/// the display holds under dots what the density says: a cell's part of the dots on its borders is chance of the
/// places, which geometry tells without noise. What a cell's whole number of dots adds or takes by rounding is left out
/// of the correction of the density: the next rounding will be another one. The most even
/// round is judged by a trace of its own. `model_luminance`: mean luminance of the density model's judging trace.
/// Empty: interrupted. Throws ConfigError if the dots cannot be placed.
std::optional<VerifiedDots> verify_dots(const DotVerification& job, const tracer::DensityField& designed,
                                        const core::Estimate& model_luminance, const VerificationHooks& hooks);

/// The greatest density whose dots these limits can hold.
double greatest_dot_density(const DotSpec& dots, double fill);

/// The step numbers of its traces: no design step and no other judging trace has them.
inline constexpr std::uint32_t kVerifyingStep = 0xFFFFF000U;  ///< plus the round
inline constexpr std::uint32_t kVerifiedStep = 0xFFFFF800U;

}  // namespace evenglow::design

#pragma once

#include <vector>

#include "core/math/vec3.h"
#include "core/montecarlo/estimate.h"
#include "design/problem/metrology.h"

/// Chromaticities of sums over batches, and what each batch adds to their errors.
namespace evenglow::design {

/// u' and v' of the sum of X, Y, Z over batches, linearized about it: residual b is what batch b moved the value by,
/// and the residuals sum to zero.
struct ChromaticityBatches {
  core::Vec2 uv = core::Vec2::Zero();
  std::vector<core::Vec2> residuals;  ///< of each batch

  core::Estimate u() const;
  core::Estimate v() const;
};

/// X, Y, Z of each batch; their sum must be light.
ChromaticityBatches chromaticity_batches(const std::vector<core::Vec3>& batches);

/// Standard error of a value whose residuals are these.
double residual_se(const std::vector<double>& residuals);

/// All figures of a color with their errors.
ColorPoint color_point(const std::vector<core::Vec3>& batches);

}  // namespace evenglow::design

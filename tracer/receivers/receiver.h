#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/math/vec3.h"
#include "tracer/geometry/mesh.h"

namespace evenglow::tracer {

/// A photon that leaves the backlight.
struct Crossing {
  Side side = Side::kTop;
  core::Vec3 position;     ///< where it crosses the plane of that side, mm
  core::Vec3 k;            ///< direction of travel
  bool estimated = false;  ///< its way from the last scatter was already counted by the next-event estimate
};

/// What a photon adds to one bin.
struct Score {
  std::size_t bin = 0;
  double weight = 0.0;
};

/// Says which bin a crossing photon belongs to; holds no numbers.
class Receiver {
 public:
  virtual ~Receiver() = default;
  virtual std::size_t bins() const = 0;
  virtual std::optional<Score> score(const Crossing& crossing) const = 0;
};

}  // namespace evenglow::tracer

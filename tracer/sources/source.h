#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/config/registry.h"
#include "tracer/geometry/mesh.h"
#include "tracer/optics/bsdf.h"
#include "tracer/optics/photon.h"

namespace evenglow::tracer {

/// A window of a source that stands in the way of returning light: a rectangle on the plane of its side.
struct SourceWindow {
  double min_along = 0.0, max_along = 0.0;  ///< mm, along the edge (y for left/right, x for front/back)
  double min_z = 0.0, max_z = 0.0;          ///< mm
};

/// Where photons begin. Positions are those of the backlight; `emit` fills position, light (I = 1)
/// and, for a source of several windows, the window's number as `quad`.
class Source {
 public:
  virtual ~Source() = default;
  virtual double flux() const = 0;  ///< lm
  virtual Photon emit(core::PhotonRng& rng) const = 0;
  /// The side of the plate that the source stands at, its distance (mm), and its body, if it has one.
  virtual Side side() const = 0;
  virtual double gap() const = 0;
  virtual std::vector<SourceWindow> windows() const { return {}; }
  virtual const Bsdf* window_surface() const { return nullptr; }
  /// What a user should know of data that were not used as they stand; empty: nothing.
  virtual std::string note() const { return {}; }
};

/// What a source needs to know of the backlight: the box of the plate (of the film stack if there is no plate), and the
/// height of the uppermost film, where a source above the backlight stands.
struct SourcePlace {
  Box box;
  double top = 0.0;  ///< mm

  /// The box whose side `face` a source lights.
  Box lit(Side face) const {
    Box result = box;
    if (face == Side::kTop) result.max.z() = top;
    return result;
  }
};

using SourcePointer = std::unique_ptr<const Source>;
/// Sources are made when the box of the backlight is known.
using SourceMaker = std::function<SourcePointer(const SourcePlace&)>;

/// A source that was read but not yet placed: its keys are checked as far as they can be without the box.
struct SourceSpec {
  std::string kind;
  Side side = Side::kLeft;
  SourceMaker place;  ///< notes its faults at the node that it was read from
};

/// One line for each kind of source.
const core::Registry<SourceSpec>& source_registry();

/// The key `edge` or `face` as a side.
Side read_side(const core::ConfigNode& node, const core::ChoiceKey& key);

/// Local axes of a side: a, b in its plane (`a` along y for left/right, along x otherwise; b along z, or y for
/// bottom/top), and the inward normal.
struct SideAxes {
  core::Vec3 a, b, inward;
};
SideAxes side_axes(Side side);

}  // namespace evenglow::tracer

#pragma once

#include <memory>
#include <vector>

#include "tracer/microstructure/dot_shape.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"

namespace evenglow::tracer {

/// The dots of a pattern that is traced dot by dot, with the optics that they have at each wavelength.
class PatternDots {
 public:
  /// Both must outlive it.
  PatternDots(const Scene& scene, const DensityField& density) : dots_(density.dots.get()) {
    if (dots_ == nullptr) return;
    for (const SceneOptics& band : scene.optics) {
      shapes_.push_back(nullptr);
      for (const Surface& surface : band.surfaces) {
        if (surface.pattern == nullptr) continue;
        shapes_.back() = dynamic_cast<const DotShape*>(surface.pattern);
        on_top_ = surface.normal.z() > 0.0;
      }
    }
  }

  /// Is the pattern traced dot by dot?
  bool given() const { return dots_ != nullptr; }
  /// The shape that has a height, null: ink.
  const DotShape* shape(std::size_t band) const { return shapes_[band]; }
  const DotGrid& grid() const { return *dots_; }
  bool on_top() const { return on_top_; }

  /// Does light that comes along k (backlight's axes) to the patterned face at this place meet the pattern?
  [[gnu::always_inline]] bool meets(const core::Vec2& place, const core::Vec3& k, std::size_t band) const {
    if (shapes_[band] == nullptr) [[likely]]
      return dots_->covers(place.x(), place.y());
    return shapes_[band]->meets_dot(*dots_, place, k);
  }

 private:
  const DotGrid* dots_;
  std::vector<const DotShape*> shapes_;  ///< of each band
  bool on_top_ = false;
};

}  // namespace evenglow::tracer

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "tracer/transport/pattern_dots.h"

namespace evenglow::tracer {

/// What stands for `PlanarCells` where the pattern is traced dot by dot: "cell" 1 is a place where light meets the
/// pattern, 0 one where it does not. Columns and rows are mm.
class PlanarDots {
 public:
  /// For one wavelength.
  class Band {
   public:
    Band(const PatternDots& dots, std::size_t band) : grid_(&dots.grid()), shape_(dots.shape(band)) {}

    double column(double x) const { return x; }
    double row(double y) const { return y; }
    double columns_per(double dx) const { return dx; }
    double rows_per(double dy) const { return dy; }
    /// Of light that comes along (kx, ky, kz) to the face.
    [[gnu::always_inline]] std::size_t cell(double x, double y, double kx, double ky, double kz) const {
      if (shape_ == nullptr) [[likely]]
        return grid_->covers(x, y) ? 1 : 0;
      return shape_->meets_dot(*grid_, {x, y}, {kx, ky, kz}) ? 1 : 0;
    }
    double open(std::size_t cell) const { return cell != 0 ? 0.0 : 1.0; }
    double depth(std::size_t cell) const { return cell != 0 ? std::numeric_limits<double>::infinity() : 0.0; }

   private:
    const DotGrid* grid_;
    const DotShape* shape_;
  };

  /// The density has dots.
  PlanarDots(const Scene& scene, const DensityField& density) {
    const PatternDots dots(scene, density);
    for (std::size_t band = 0; band < scene.optics.size(); ++band) bands_.emplace_back(dots, band);
  }
  const Band& of(std::size_t band) const { return bands_[band]; }

 private:
  std::vector<Band> bands_;
};

}  // namespace evenglow::tracer

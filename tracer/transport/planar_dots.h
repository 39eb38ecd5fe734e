#pragma once

#include <cmath>
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
    static constexpr bool kMovesLight = true;
    Band(const PatternDots& dots, std::size_t band)
        : grid_(&dots.grid()), shape_(dots.shape(band)), outward_(dots.on_top() ? 1.0 : -1.0) {}

    double column(double x) const { return x; }
    double row(double y) const { return y; }
    double columns_per(double dx) const { return dx; }
    double rows_per(double dy) const { return dy; }
    /// Of light that comes to the face as it goes now.
    template <typename Light>
    [[gnu::always_inline]] std::size_t cell_met(double x, double y, const Light& k) const {
      return meets(x, y, k.kx, k.ky, k.kz) ? 1 : 0;
    }
    /// Of light from inside that is reflected at bottom and top until it comes to the face.
    template <typename Light>
    [[gnu::always_inline]] std::size_t cell_inside(double x, double y, const Light& k) const {
      return meets(x, y, k.kx, k.ky, outward_ * std::abs(k.kz)) ? 1 : 0;
    }
    double open(std::size_t cell) const { return cell != 0 ? 0.0 : 1.0; }
    double depth(std::size_t cell) const { return cell != 0 ? std::numeric_limits<double>::infinity() : 0.0; }

   private:
    [[gnu::always_inline]] bool meets(double x, double y, double kx, double ky, double kz) const {
      if (shape_ == nullptr) [[likely]]
        return grid_->covers(x, y);
      return shape_->meets_dot(*grid_, {x, y}, {kx, ky, kz});
    }

    const DotGrid* grid_;
    const DotShape* shape_;
    double outward_;  ///< 1: the face is the top, -1: the bottom
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

#pragma once

#include <string>
#include <vector>

#include "design/report/drawing.h"

/// The backlight in section, with the ways of a few photons.
namespace evenglow::design {

/// What a layer is drawn as.
enum class LayerKind { reflector, body, film };

/// A layer of the stack, mm; a film without thickness has bottom = top.
struct SectionLayer {
  std::string name;
  LayerKind kind = LayerKind::film;
  double bottom = 0.0;
  double top = 0.0;
};

/// How light of a stretch of a way is polarized.
enum class PolarizationLook { unpolarized, along_x, along_y, circular };

/// A photon's way in the plane of x and z, mm; `looks[i]` is that of the stretch from point i to i + 1.
struct SectionPath {
  std::vector<Point> points;  ///< x; y is the height z
  std::vector<PolarizationLook> looks;
  std::string fate;
};

struct SectionView {
  std::string title;
  double x_min = 0.0;  ///< mm, the stretch of the backlight that is shown
  double x_max = 1.0;
  std::vector<SectionLayer> layers;  ///< from below
  std::vector<SectionPath> paths;
};

/// From height to height in the picture: each gap and each body has a height of its own, enough to be seen, and heights
/// between are linear, so that a way stays a chain of straight stretches within each.
class SectionHeights {
 public:
  SectionHeights(const std::vector<SectionLayer>& layers, double picture_top);
  double operator()(double z) const;  ///< px, downwards
  double picture_height() const { return marks_.front().px; }

 private:
  struct Mark {
    double z;
    double px;
  };
  std::vector<Mark> marks_;  ///< rising in z, falling in px
};

/// An SVG element in the classes of the page's style sheet.
std::string section_svg(const SectionView& view);
/// The same as a file of its own, with colors.
std::string section_svg_file(const SectionView& view);

}  // namespace evenglow::design

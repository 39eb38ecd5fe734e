#pragma once

#include <array>
#include <cstdint>
#include <string>

/// Colors of maps and curves.
namespace evenglow::design {

struct Rgb {
  double red = 0.0;  ///< sRGB, 0 to 1
  double green = 0.0;
  double blue = 0.0;

  std::string hex() const;  ///< "1f6feb"
};

/// A scale of 256 colors. Of `luminance` and `density` the lightness L* of CIELAB rises in equal steps, so that equal
/// steps of the value look equal and the picture stays right in gray print; the hue runs along with it.
class ColorMap {
 public:
  static const ColorMap& luminance();  ///< violet, blue, green, yellow
  static const ColorMap& density();    ///< near black, petrol, pale
  /// Blue, gray, red: L* falls in equal steps from the middle (no difference) to both ends.
  static const ColorMap& difference();
  /// Blue, cyan, green, yellow, red, as in the literature on backlights. Not perceptually uniform: it shows edges
  /// where there are none.
  static const ColorMap& rainbow();

  /// `share` of the scale, 0 to 1; outside: the end. Not a number: `no_data()`.
  Rgb at(double share) const;
  static Rgb no_data() { return {0.6, 0.6, 0.6}; }
  /// All 256 colors, six hexadecimal digits each.
  std::string hex() const;

 private:
  struct Path;
  explicit ColorMap(const Path& path);
  explicit ColorMap(const std::array<Rgb, 256>& colors) : colors_(colors) {}
  std::array<Rgb, 256> colors_;
};

}  // namespace evenglow::design

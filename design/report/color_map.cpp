#include "design/report/color_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace evenglow::design {
namespace {

/// From CIELAB (ISO/CIE 11664-4, white D65) to linear sRGB (IEC 61966-2-1). Components outside [0, 1] are out of gamut.
Rgb linear_srgb(double lightness, double chroma, double hue_deg) {
  const double hue = hue_deg * std::numbers::pi / 180.0;
  const auto inverse = [](double t) { return t > 6.0 / 29.0 ? t * t * t : 3.0 * 36.0 / 841.0 * (t - 4.0 / 29.0); };
  const double f = (lightness + 16.0) / 116.0;
  const double x = 0.95047 * inverse(f + chroma * std::cos(hue) / 500.0);
  const double y = inverse(f);
  const double z = 1.08883 * inverse(f - chroma * std::sin(hue) / 200.0);
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

bool in_gamut(const Rgb& c) {
  const auto inside = [](double v) { return v >= 0.0 && v <= 1.0; };
  return inside(c.red) && inside(c.green) && inside(c.blue);
}

double companded(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

/// The color of this lightness and hue with the given chroma, or with the most that sRGB can show.
Rgb nearest_srgb(double lightness, double chroma, double hue_deg) {
  double low = 0.0;
  double high = chroma;
  if (in_gamut(linear_srgb(lightness, chroma, hue_deg))) low = chroma;
  for (int i = 0; i < 40 && low < chroma; ++i) {
    const double middle = 0.5 * (low + high);
    (in_gamut(linear_srgb(lightness, middle, hue_deg)) ? low : high) = middle;
  }
  const Rgb c = linear_srgb(lightness, low, hue_deg);
  const auto display = [](double v) { return companded(std::clamp(v, 0.0, 1.0)); };
  return {display(c.red), display(c.green), display(c.blue)};
}

}  // namespace

/// Straight lines from dark to bright in lightness and hue, a parabola in chroma (a Bezier curve of degree 2). The
/// numbers are chosen so that the path stays within sRGB: clipping would show as a false edge in a smooth map.
struct ColorMap::Path {
  double lightness_dark, lightness_bright;
  double hue_dark, hue_bright;  ///< degrees
  double chroma_dark, chroma_middle, chroma_bright;
};

ColorMap::ColorMap(const Path& path) : colors_{} {
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    const double t = static_cast<double>(i) / 255.0;
    const double chroma =
        path.chroma_dark * (1 - t) * (1 - t) + 2 * path.chroma_middle * t * (1 - t) + path.chroma_bright * t * t;
    colors_[i] = nearest_srgb(std::lerp(path.lightness_dark, path.lightness_bright, t), chroma,
                              std::lerp(path.hue_dark, path.hue_bright, t));
  }
}

const ColorMap& ColorMap::luminance() {
  static const ColorMap map(Path{15, 91, 318, 100, 40, -1, 84});
  return map;
}

const ColorMap& ColorMap::density() {
  static const ColorMap map(Path{14, 95, 250, 180, 15.5, 28.5, 8});
  return map;
}

const ColorMap& ColorMap::difference() {
  static const ColorMap map([] {
    std::array<Rgb, 256> colors;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double t = static_cast<double>(i) / 255.0;
      const double away = std::abs(2.0 * t - 1.0);
      colors[i] = nearest_srgb(std::lerp(93.0, 35.0, away), 44.0 * away, t < 0.5 ? 282.0 : 38.0);
    }
    return colors;
  }());
  return map;
}

const ColorMap& ColorMap::rainbow() {
  static const ColorMap map([] {
    std::array<Rgb, 256> colors;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double t = static_cast<double>(i) / 255.0;
      const auto ramp = [&](double center) { return std::clamp(1.5 - std::abs(4.0 * t - center), 0.0, 1.0); };
      colors[i] = {ramp(3.0), ramp(2.0), ramp(1.0)};
    }
    return colors;
  }());
  return map;
}

Rgb ColorMap::at(double share) const {
  if (std::isnan(share)) return no_data();
  return colors_[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0))];
}

std::string ColorMap::hex() const {
  std::string text;
  for (const Rgb& color : colors_) text += color.hex();
  return text;
}

std::string Rgb::hex() const {
  const auto byte = [](double v) { return static_cast<int>(std::lround(v * 255.0)); };
  return fmt::format("{:02x}{:02x}{:02x}", byte(red), byte(green), byte(blue));
}

}  // namespace evenglow::design

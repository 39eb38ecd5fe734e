#include "core/light/color.h"

#include <cmath>

#include "core/light/cie_1931.h"

namespace evenglow::core {
namespace {

constexpr double kC2 = 1.4388e7;  // nm K
constexpr double kColdest = 1000.0, kHottest = 40000.0;

/// CIE 1960 (u, v), in which color temperatures are defined.
Vec2 uv_1960(const Vec3& xyz) {
  const Vec2 uv = chromaticity_uv(xyz);
  return {uv.x(), uv.y() * (2.0 / 3.0)};
}

}  // namespace

Vec2 chromaticity_xy(const Vec3& xyz) {
  const double sum = xyz.sum();
  return sum > 0.0 ? Vec2(xyz.x() / sum, xyz.y() / sum) : Vec2::Zero();
}

Vec2 chromaticity_uv(const Vec3& xyz) {
  const double sum = xyz.x() + 15.0 * xyz.y() + 3.0 * xyz.z();
  return sum > 0.0 ? Vec2(4.0 * xyz.x() / sum, 9.0 * xyz.y() / sum) : Vec2::Zero();
}

Vec3 black_body(double temperature) {
  Vec3 sum = Vec3::Zero();
  for (double nm = kShortestVisible; nm <= kLongestVisible; nm += 5.0) {
    const double power = std::pow(nm / 560.0, -5.0) / std::expm1(kC2 / (nm * temperature));
    sum += power * color_matching(nm);
  }
  return sum / sum.y();
}

ColorTemperature color_temperature(const Vec3& xyz) {
  if (!(xyz.sum() > 0.0)) return {};
  const Vec2 target = uv_1960(xyz);
  const auto distance = [&](double reciprocal) { return (uv_1960(black_body(1.0 / reciprocal)) - target).norm(); };
  // Along 1/T the locus is traversed almost evenly, and the distance has one minimum where it is meaningful.
  double low = 1.0 / kHottest, high = 1.0 / kColdest;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = distance(a), at_b = distance(b);
  while (high - low > 1e-12) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = distance(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = distance(b = low + golden * (high - low));
    }
  }
  const double kelvin = 2.0 / (low + high);
  const Vec2 away = target - uv_1960(black_body(kelvin));
  return {kelvin, std::copysign(away.norm(), away.y())};
}

}  // namespace evenglow::core

#include "design/problem/chromaticity_batches.h"

#include <cmath>

#include "core/light/color.h"

namespace evenglow::design {
namespace {

using core::Vec2;
using core::Vec3;

Vec3 sum_of(const std::vector<Vec3>& batches) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& xyz : batches) sum += xyz;
  return sum;
}

/// Light of this (u', v') with Y = 1.
Vec3 light_of(const Vec2& uv) {
  return {9.0 * uv.x() / (4.0 * uv.y()), 1.0, (12.0 - 3.0 * uv.x() - 20.0 * uv.y()) / (4.0 * uv.y())};
}

core::Estimate with_error(double value, const ChromaticityBatches& color, const Vec2& gradient) {
  std::vector<double> residuals;
  residuals.reserve(color.residuals.size());
  for (const Vec2& r : color.residuals) residuals.push_back(gradient.dot(r));
  return {value, residual_se(residuals)};
}

/// The temperature is found by a search: its gradient over a step that is long beside the search's tolerance.
void add_temperature(const ChromaticityBatches& color, ColorPoint& point) {
  constexpr double kStep = 1e-4;
  const core::ColorTemperature here = core::color_temperature(light_of(color.uv));
  Vec2 kelvin, distance;
  for (int i = 0; i < 2; ++i) {
    Vec2 step = Vec2::Zero();
    step[i] = kStep;
    const core::ColorTemperature up = core::color_temperature(light_of(color.uv + step));
    const core::ColorTemperature down = core::color_temperature(light_of(color.uv - step));
    kelvin[i] = (up.kelvin - down.kelvin) / (2.0 * kStep);
    distance[i] = (up.distance - down.distance) / (2.0 * kStep);
  }
  point.kelvin = with_error(here.kelvin, color, kelvin);
  point.distance = with_error(here.distance, color, distance);
}

}  // namespace

double residual_se(const std::vector<double>& residuals) {
  const double count = static_cast<double>(residuals.size());
  double squares = 0.0;
  for (const double r : residuals) squares += r * r;
  return count > 1.0 ? std::sqrt(squares * count / (count - 1.0)) : 0.0;
}

core::Estimate ChromaticityBatches::u() const {
  return with_error(uv.x(), *this, Vec2::UnitX());
}

core::Estimate ChromaticityBatches::v() const {
  return with_error(uv.y(), *this, Vec2::UnitY());
}

ChromaticityBatches chromaticity_batches(const std::vector<Vec3>& batches) {
  const Vec3 sum = sum_of(batches);
  const Vec3 denominator(1.0, 15.0, 3.0);
  const double all = denominator.dot(sum);
  ChromaticityBatches color;
  color.uv = core::chromaticity_uv(sum);
  color.residuals.reserve(batches.size());
  for (const Vec3& xyz : batches) {
    const double part = denominator.dot(xyz);
    color.residuals.emplace_back((4.0 * xyz.x() - color.uv.x() * part) / all,
                                 (9.0 * xyz.y() - color.uv.y() * part) / all);
  }
  return color;
}

ColorPoint color_point(const std::vector<Vec3>& batches) {
  const ChromaticityBatches color = chromaticity_batches(batches);
  const Vec3 sum = sum_of(batches);
  const Vec2 xy = core::chromaticity_xy(sum);
  std::vector<double> x, y;
  for (const Vec3& xyz : batches) {
    x.push_back((xyz.x() - xy.x() * xyz.sum()) / sum.sum());
    y.push_back((xyz.y() - xy.y() * xyz.sum()) / sum.sum());
  }
  ColorPoint point;
  point.x = {xy.x(), residual_se(x)};
  point.y = {xy.y(), residual_se(y)};
  point.u = color.u();
  point.v = color.v();
  add_temperature(color, point);
  return point;
}

}  // namespace evenglow::design

#include "tracer/polarized_bsdf/lobe_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

/// Reflectance of a plate with two smooth faces for natural light, all orders of reflection, no interference.
double plate_reflectance(double sigma, double n) {
  const double c = std::cos(sigma);
  if (c < 1e-12) return 1.0;
  const double s = std::sin(sigma) / n;
  const double ct = std::sqrt(1.0 - s * s);
  const double rs = std::pow((c - n * ct) / (c + n * ct), 2);
  const double rp = std::pow((n * c - ct) / (n * c + ct), 2);
  return rs / (1.0 + rs) + rp / (1.0 + rp);
}

}  // namespace

double lobe_integral(double sx, double sy) {
  constexpr int kAngles = 256;
  double sum = 0.0;
  for (int i = 0; i < kAngles; ++i) {
    const double angle = core::kPi * i / kAngles;
    const double a = std::pow(std::cos(angle) / sx, 2) + std::pow(std::sin(angle) / sy, 2);
    sum += -std::expm1(-0.5 * a) / a;
  }
  return 2.0 * core::kPi * sum / kAngles;
}

double LobeModel::Lobe::at(double dx, double dy) const {
  return amplitude * std::exp(-0.5 * (dx * dx / (sx * sx) + dy * dy / (sy * sy)));
}

LobeModel::LobeModel(const LobeParameters& parameters) : parameters_(parameters) {
  describe();
  check();
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (const FilmLight light : {FilmLight::pass, FilmLight::block}) solve(kind, light);
  }
}

void LobeModel::describe() {
  const LobeParameters& p = parameters_;
  const auto lobe = [&](double luminance, double sx, double sy) { return Lobe{luminance / p.e0, sx, sy}; };
  const auto round = [&](double luminance, double s) { return lobe(luminance, s, s); };
  parts_[0][0].scaled = {lobe(p.p1, p.sx, p.sy)};
  parts_[0][0].fixed = {round(p.p3, p.s3p)};
  parts_[0][1].scaled = {lobe(p.b1, p.sx, p.sy), round(p.b2, p.s2), round(p.b3, p.s3b)};
  parts_[1][0].scaled = {round(p.a1, p.t1), round(p.a2, p.t2), round(p.a3, p.t3)};
  parts_[1][1].scaled = {round(p.a2b, p.t2), round(p.a3b, p.t3)};
}

void LobeModel::check() const {
  for (const FilmLight light : {FilmLight::pass, FilmLight::block}) {
    const std::string name = light == FilmLight::pass ? "pass" : "block";
    const double T = unscaled(ScatterKind::transmission, light);
    const double most = 1.0 - parameters_.absorption;
    if (T > most) {
      throw core::Error(
          fmt::format("transmittance of {} light must be at most 1 - absorption = {:g}, got {:g}", name, most, T));
    }
    if (unscaled(ScatterKind::reflection, light) == 0.0 && T < most) {
      throw core::Error(
          fmt::format("reflected {} light needs a lobe (what is neither transmitted nor absorbed)", name));
    }
  }
  const double wide = parameters_.p3 / parameters_.e0 * lobe_integral(parameters_.s3p, parameters_.s3p);
  const double R = hemispherical(ScatterKind::reflection, FilmLight::pass, 0.0);
  if (wide >= R || (wide < R && parameters_.p1 == 0.0)) {
    throw core::Error(
        fmt::format("the wide lobe of reflected pass light must leave room for the narrow one below "
                    "1 - absorption - T = {:g}, got {:g}",
                    R, wide));
  }
}

double LobeModel::unscaled(ScatterKind kind, FilmLight light) const {
  double sum = 0.0;
  for (const auto* lobes : {&part(kind, light).scaled, &part(kind, light).fixed}) {
    for (const Lobe& lobe : *lobes) sum += lobe.amplitude * lobe_integral(lobe.sx, lobe.sy);
  }
  return sum;
}

double LobeModel::hemispherical(ScatterKind kind, FilmLight light, double sigma) const {
  const double n = parameters_.refractive_index;
  const double T = unscaled(ScatterKind::transmission, light) * (1.0 - plate_reflectance(sigma, n)) /
                   (1.0 - plate_reflectance(0.0, n));
  return kind == ScatterKind::transmission ? T : 1.0 - parameters_.absorption - T;
}

double LobeModel::scaling(ScatterKind kind, FilmLight light, const Beta& beta) const {
  const std::vector<double>& c = part(kind, light).c;
  const double x = std::min(std::abs(beta.x), 1.0) * kSteps;
  const double y = std::min(std::abs(beta.y), 1.0) * kSteps;
  const auto ix = std::min(static_cast<std::size_t>(x), kSteps - 1);
  const auto iy = std::min(static_cast<std::size_t>(y), kSteps - 1);
  const double tx = x - static_cast<double>(ix);
  const double ty = y - static_cast<double>(iy);
  const double* at = &c[ix * kNodes + iy];
  return (1.0 - tx) * ((1.0 - ty) * at[0] + ty * at[1]) + tx * ((1.0 - ty) * at[kNodes] + ty * at[kNodes + 1]);
}

double LobeModel::bsdf(ScatterKind kind, FilmLight light, const Beta& in, const Beta& out) const {
  const double dx = out.x - in.x;
  const double dy = out.y - in.y;
  double scaled = 0.0;
  for (const Lobe& lobe : part(kind, light).scaled) scaled += lobe.at(dx, dy);
  double sum = scaled * scaling(kind, light, in) * scaling(kind, light, out);
  for (const Lobe& lobe : part(kind, light).fixed) sum += lobe.at(dx, dy);
  return sum;
}

LobeModel::Value LobeModel::at(ScatterKind kind, double psi, double sigma, double phi, double theta) const {
  const double s = std::sin(sigma), c = std::cos(sigma);
  // Along the specular (direct) axis, away from it in the plane of incidence, and across.
  const double along = std::cos(theta), in_plane = std::sin(theta) * std::cos(phi);
  const double bx = along * s + in_plane * c;
  const double by = std::sin(theta) * std::sin(phi);
  if (along * c - in_plane * s <= 0.0) return {};
  const double cp = std::cos(psi), sp = std::sin(psi);
  const Beta in{s * cp, -s * sp};
  const Beta out{bx * cp + by * sp, by * cp - bx * sp};
  return {bsdf(kind, FilmLight::pass, in, out), bsdf(kind, FilmLight::block, in, out)};
}

}  // namespace evenglow::tracer

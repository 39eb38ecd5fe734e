#include "tracer/transport/reversed_bsdf.h"

#include <cmath>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tracer/films/dbef.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tracer {
namespace {

using core::StokesVector;
using core::Vec3;

/// Share of the proposals that are cosine-distributed over both sides: bounds the weights where a table is far from
/// reciprocal.
constexpr double kEvenShare = 0.1;

Vec3 mirrored(const Vec3& k) {
  return {k.x(), k.y(), -k.z()};
}

/// M^T w for a matrix between the tangential frames of `k_in` and the importance.
StokesVector pulled_back(const core::MuellerMatrix& M, const StokesVector& importance, const Vec3& k_in) {
  const Eigen::Vector4d w = to_film(importance, tangential_frame(importance.frame.k));
  return from_film(M.transpose() * w, tangential_frame(k_in));
}

std::optional<StokesVector> step_specular(const Bsdf& surface, const StokesVector& w, bool lit_from_below,
                                          core::PhotonRng& rng) {
  const Vec3& k = w.frame.k;
  const Vec3 other = mirrored(k);
  const auto through = [&] { return pulled_back(surface.specular(k).transmission, w, k); };
  const auto back = [&] { return pulled_back(surface.specular(other).reflection, w, other); };
  if (lit_from_below) {
    const StokesVector only = k.z() > 0.0 ? through() : back();
    if (only.I <= 0.0) return std::nullopt;
    return only;
  }
  const StokesVector passed = through(), returned = back();
  const double total = passed.I + returned.I;
  // Absorption by the odds, so that the weight stays; a film that is not reciprocal might return more than it got.
  const double whole = std::max(total, w.I);
  const double chance = rng.uniform() * whole;
  if (chance >= total) return std::nullopt;
  const StokesVector& chosen = chance < passed.I ? passed : returned;
  return chosen.scaled(whole / chosen.I);
}

/// M^T w of the scattering part between k_in and the importance (1/sr).
StokesVector response(const Bsdf& surface, const StokesVector& w, const Vec3& k_in) {
  if (const auto* table = dynamic_cast<const TabulatedDbef*>(&surface)) return table->pulled_back(w, k_in);
  const core::PolarizationFrame in = core::PolarizationFrame::any(k_in);
  const Vec3& k = w.frame.k;
  const auto sent = [&](double Q, double U, double V) {
    return joined(w, surface.evaluate(StokesVector{1.0, Q, U, V, in}, k));
  };
  const double natural = sent(0.0, 0.0, 0.0);
  return {natural, sent(1.0, 0.0, 0.0) - natural, sent(0.0, 1.0, 0.0) - natural, sent(0.0, 0.0, 1.0) - natural, in};
}

std::optional<StokesVector> step_scatter(const Bsdf& surface, const StokesVector& w, core::PhotonRng& rng) {
  const StokesVector back = reversed(w);
  Vec3 k_in;
  if (rng.uniform() < kEvenShare) {
    const double u1 = rng.uniform();
    k_in = core::sample_lambertian(u1, rng.uniform());
    if (rng.uniform() < 0.5) k_in = mirrored(k_in);
  } else {
    const auto sample = surface.sample(back, rng);
    if (!sample) return std::nullopt;
    k_in = -sample->light.frame.k;
    if (sample->specular) {
      const bool passes = k_in.z() * w.frame.k.z() > 0.0;
      const Bsdf::Specular forward = surface.specular(k_in), reverse = surface.specular(back.frame.k);
      const Eigen::Vector4d light = to_film(back, tangential_frame(back.frame.k));
      const double odds = (passes ? reverse.transmission : reverse.reflection).row(0).dot(light) / w.I;
      return pulled_back(passes ? forward.transmission : forward.reflection, w, k_in)
          .scaled(1.0 / ((1.0 - kEvenShare) * odds));
    }
  }
  const double cosine = std::abs(k_in.z());
  const double density = (1.0 - kEvenShare) * surface.pdf(back, -k_in) + kEvenShare * cosine / (2.0 * core::kPi);
  return response(surface, w, k_in).scaled(cosine / density);
}

}  // namespace

std::optional<StokesVector> step_back(const Bsdf& surface, const StokesVector& importance, BackwardPart part,
                                      core::PhotonRng& rng) {
  const bool bends = surface.redirects() || dynamic_cast<const DielectricFace*>(&surface) != nullptr;
  if (bends) {
    const auto sample = surface.sample(reversed(importance), rng);
    if (!sample) return std::nullopt;
    return reversed(sample->light);
  }
  if (surface.scatters() && part != BackwardPart::kSpecular) return step_scatter(surface, importance, rng);
  return step_specular(surface, importance, part == BackwardPart::kLitFromBelow, rng);
}

}  // namespace evenglow::tracer

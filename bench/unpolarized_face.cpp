#include "bench/unpolarized_face.h"

#include <cmath>
#include <memory>

namespace evenglow::bench {
namespace {

using core::StokesVector;
using core::Vec3;

class UnpolarizedFace final : public tracer::Bsdf {
 public:
  UnpolarizedFace(double n_below, double n_above) : n_below_(n_below), n_above_(n_above) {}

  std::optional<tracer::BsdfSample> sample(const StokesVector& incident, core::PhotonRng& rng) const override {
    const Vec3& k = incident.frame.k;
    const double n1 = k.z() > 0.0 ? n_below_ : n_above_;
    const double n2 = k.z() > 0.0 ? n_above_ : n_below_;
    const double bend = n1 / n2;
    const double cos_i = std::abs(k.z());
    const double sin2_t = bend * bend * (1.0 - cos_i * cos_i);
    if (sin2_t >= 1.0) return towards({k.x(), k.y(), -k.z()});
    const double cos_t = std::sqrt(1.0 - sin2_t);
    const double r_s = (n1 * cos_i - n2 * cos_t) / (n1 * cos_i + n2 * cos_t);
    const double r_p = (n2 * cos_i - n1 * cos_t) / (n2 * cos_i + n1 * cos_t);
    if (rng.uniform() < 0.5 * (r_s * r_s + r_p * r_p)) return towards({k.x(), k.y(), -k.z()});
    return towards({k.x() * bend, k.y() * bend, std::copysign(cos_t, k.z())});
  }
  StokesVector evaluate(const StokesVector&, const Vec3&) const override { return {}; }
  bool scatters() const override { return false; }
  Specular specular(const Vec3&) const override { return {}; }

 private:
  /// The first axis is of no account: nobody turns unpolarized light.
  static tracer::BsdfSample towards(const Vec3& k) { return {{1.0, 0.0, 0.0, 0.0, {k, Vec3::UnitX()}}, true}; }

  double n_below_;
  double n_above_;
};

}  // namespace

void forget_polarization(BenchScene& bench) {
  for (tracer::Surface& surface : bench.scene.optics[0].surfaces) {
    if (surface.body < 0) continue;
    const double index = bench.scene.optics[0].bodies[static_cast<std::size_t>(surface.body)].refractive_index;
    bench.scene.optics[0].owned.push_back(std::make_unique<UnpolarizedFace>(index, 1.0));
    surface.optics = bench.scene.optics[0].owned.back().get();
  }
}

}  // namespace evenglow::bench

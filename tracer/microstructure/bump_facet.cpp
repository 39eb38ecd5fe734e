#include "tracer/microstructure/bump_facet.h"

#include <cmath>

namespace evenglow::tracer {

using core::StokesVector;
using core::Vec3;

FacetMeeting meet_facet(const DielectricFace& face, const Vec3& normal, const StokesVector& light, bool from_inside,
                        core::PhotonRng& rng) {
  const Vec3 x = core::PolarizationFrame::any(normal).e1;
  const Vec3 y = normal.cross(x);
  const auto local = [&](const Vec3& v) { return Vec3(x.dot(v), y.dot(v), normal.dot(v)); };
  const auto world = [&](const Vec3& v) { return Vec3(v.x() * x + v.y() * y + v.z() * normal); };
  Vec3 k = local(light.frame.k);
  k.z() = from_inside ? std::abs(k.z()) : -std::abs(k.z());
  const StokesVector seen{light.I, light.Q, light.U, light.V, {k, local(light.frame.e1)}};
  const StokesVector out = face.sample(seen, rng)->light;
  const bool passed = (out.frame.k.z() > 0.0) == from_inside;
  return {{out.I, out.Q, out.U, out.V, {world(out.frame.k), world(out.frame.e1)}}, passed};
}

}  // namespace evenglow::tracer

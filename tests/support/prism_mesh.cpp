#include "tests/support/prism_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;

StokesVector in_axes(const StokesVector& s, const Vec3& x, const Vec3& y, const Vec3& z) {
  const auto turn = [&](const Vec3& v) { return Vec3(x.dot(v), y.dot(v), z.dot(v)); };
  return {s.I, s.Q, s.U, s.V, {turn(s.frame.k), turn(s.frame.e1)}};
}

StokesVector out_of_axes(const StokesVector& s, const Vec3& x, const Vec3& y, const Vec3& z) {
  const auto turn = [&](const Vec3& v) -> Vec3 { return v.x() * x + v.y() * y + v.z() * z; };
  return {s.I, s.Q, s.U, s.V, {turn(s.frame.k), turn(s.frame.e1)}};
}

}  // namespace

std::vector<tracer::PrismPoint> PrismMesh::flat_border(double flat, double apex) {
  const double height = (0.5 - 0.5 * flat) / std::tan(0.5 * apex);
  if (flat == 0.0) return {{-0.5, 0.0}, {0.0, height}, {0.5, 0.0}};
  return {{-0.5, 0.0}, {-0.5 * flat, height}, {0.5 * flat, height}, {0.5, 0.0}};
}

std::vector<tracer::PrismPoint> PrismMesh::round_border(double radius, double apex, int pieces) {
  const double slope = 0.5 * (core::kPi - apex);  // of a facet against the film
  const double half_tip = radius * std::sin(slope);
  const double center = (0.5 - half_tip) * std::tan(slope) - radius * std::cos(slope);
  std::vector<tracer::PrismPoint> border{{-0.5, 0.0}};
  for (int i = 0; i <= pieces; ++i) {
    const double a = slope * (2.0 * i / pieces - 1.0);
    border.push_back({radius * std::sin(a), center + radius * std::cos(a)});
  }
  border.push_back({0.5, 0.0});
  return border;
}

PrismMesh::PrismMesh(const Shape& shape) : shape_(shape) {
  std::vector<tracer::Quad> quads;
  const double x0 = -0.5 * shape_.length;
  const double y0 = -0.5 * shape_.prisms;
  // Outward normals u x v: the flat face looks down, the prisms up.
  quads.push_back({Vec3(x0, y0, -shape_.base), Vec3(0, shape_.prisms, 0), Vec3(shape_.length, 0, 0)});
  for (int i = 0; i < shape_.prisms; ++i) {
    for (std::size_t j = 0; j + 1 < shape_.border.size(); ++j) {
      const auto& a = shape_.border[j];
      const auto& b = shape_.border[j + 1];
      top_ = std::max(top_, b.z);
      quads.push_back({Vec3(x0, y0 + i + 0.5 + a.y, a.z), Vec3(shape_.length, 0, 0), Vec3(0, b.y - a.y, b.z - a.z)});
    }
  }
  for (const auto& quad : quads) normals_.push_back(quad.normal());
  caster_.emplace(std::move(quads));
}

tracer::RayHit PrismMesh::next_hit(const Vec3& from, const Vec3& k, int skip, bool inside) const {
  const auto possible = [&](int quad) {
    const double slope = normals_[static_cast<std::size_t>(quad)].dot(k);
    return quad != skip && (inside ? slope > 0.0 : slope < 0.0);
  };
  const auto hit = caster_->nearest(from, k, skip);
  if (hit.quad < 0 ? !inside : possible(hit.quad)) return hit;
  return caster_->nearest_exact(from, k, possible);
}

std::optional<StokesVector> PrismMesh::trace(const StokesVector& incident, core::PhotonRng& rng) const {
  const tracer::DielectricFace face(shape_.refractive_index, 1.0);
  StokesVector light = incident;
  const bool upward = light.frame.k.z() > 0.0;
  Vec3 position(0.0, rng.uniform() - 0.5, upward ? -shape_.base - 0.5 : top_ + 0.5);
  bool inside = false;
  int quad = -1;
  for (;;) {
    const auto hit = next_hit(position, light.frame.k, quad, inside);
    if (hit.quad < 0) {
      const bool over_the_rim = std::abs(position.y()) > 0.49 * shape_.prisms;
      return inside || over_the_rim ? std::nullopt : std::optional(light);
    }
    const Vec3& z = normals_[static_cast<std::size_t>(hit.quad)];
    const Vec3 x = Vec3::UnitX();
    const Vec3 y = z.cross(x);
    const auto sample = face.sample(in_axes(light, x, y, z), rng);
    light = out_of_axes(sample->light, x, y, z);
    inside = sample->light.frame.k.z() < 0.0;
    position = hit.position;
    quad = hit.quad;
    // The film goes on for ever and is the same one period on: light that nearly grazes it runs far.
    if (quad == 0 && inside) position = Vec3(0.0, position.y() - std::round(position.y()), position.z());
  }
}

}  // namespace evenglow::tests

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tests/support/bump_mesh.h"

/// The triangles of each shape.
namespace evenglow::tests {
namespace {

using core::Vec3;

constexpr int kAround = 720;  // a multiple of 8, so that a square's corners are among the rays from its center
constexpr int kRings = 96;

}  // namespace

void BumpMesh::add(const Vec3& a, const Vec3& b, const Vec3& c, Face face) {
  const double up = pattern_.sunk ? -1.0 : 1.0;
  for (const Vec3& v : {a, b, c}) corners_.emplace_back(v.x(), v.y(), up * v.z());
  faces_.push_back(face);
}

void BumpMesh::add_round() {
  const bool cap = pattern_.shape == BumpPattern::Shape::kCap;
  const double radius = (1.0 + height_ * height_) / (2.0 * height_);
  std::vector<std::pair<double, double>> profile;  // radius and height from the tip to the rim
  if (cap) {
    const double edge = height_ < 1.0 ? std::asin(1.0 / radius) : 0.5 * core::kPi;
    for (int i = 0; i <= kRings; ++i) {
      const double angle = edge * i / kRings;
      profile.emplace_back(radius * std::sin(angle), radius * (std::cos(angle) - std::cos(edge)));
    }
  } else {
    profile = {{0.0, height_}, {pattern_.truncation, height_}, {1.0, 0.0}};
  }
  const auto at = [](std::pair<double, double> point, int around) {
    const double a = 2.0 * core::kPi * around / kAround;
    return Vec3(point.first * std::cos(a), point.first * std::sin(a), point.second);
  };
  for (int j = 0; j < kAround; ++j) {
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const bool flat = !cap && i == 0;
      const Face face = cap ? Face::kCap : flat ? Face::kFlat : Face::kCone;
      if (profile[i + 1].first <= 0.0) continue;
      add(at(profile[i], j), at(profile[i + 1], j), at(profile[i + 1], j + 1), face);
      if (profile[i].first > 0.0) add(at(profile[i], j), at(profile[i + 1], j + 1), at(profile[i], j + 1), face);
    }
    if (pattern_.cell <= 0.0) continue;
    const auto wall = [&](int around) {
      const double a = 2.0 * core::kPi * around / kAround;
      const double reach = pattern_.cell / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
      return Vec3(reach * std::cos(a), reach * std::sin(a), 0.0);
    };
    add(at({1.0, 0.0}, j), wall(j), wall(j + 1), Face::kFlat);
    add(at({1.0, 0.0}, j), wall(j + 1), at({1.0, 0.0}, j + 1), Face::kFlat);
  }
}

void BumpMesh::add_pyramid() {
  const double t = pattern_.truncation;
  const Vec3 base[] = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  Vec3 top[4];
  for (int i = 0; i < 4; ++i) top[i] = Vec3(t * base[i].x(), t * base[i].y(), height_);
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add(base[i], base[j], top[j], Face::kFlat);
    if (t > 0.0) add(base[i], top[j], top[i], Face::kFlat);
  }
  if (t > 0.0) {
    add(top[0], top[1], top[2], Face::kFlat);
    add(top[0], top[2], top[3], Face::kFlat);
  }
  add_square_frame();
}

void BumpMesh::add_square_frame() {
  if (pattern_.cell <= 1.0) return;
  const double c = pattern_.cell;
  const Vec3 inner[] = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add(inner[i], c * inner[i], c * inner[j], Face::kFlat);
    add(inner[i], c * inner[j], inner[j], Face::kFlat);
  }
}

void BumpMesh::add_groove() {
  const double tl = std::tan(pattern_.flank), tr = std::tan(pattern_.right);
  height_ = 2.0 * tl * tr / (tl + tr);
  const double ridge = height_ / tl - 1.0;
  const double c = std::max(1.0, pattern_.cell);
  const auto strip = [&](double x0, double z0, double x1, double z1) {
    const Vec3 a(x0, -c, z0), b(x1, -c, z1), d(x1, c, z1), e(x0, c, z0);
    add(a, b, d, Face::kFlat);
    add(a, d, e, Face::kFlat);
  };
  strip(-1.0, 0.0, ridge, height_);
  strip(ridge, height_, 1.0, 0.0);
  if (c > 1.0) {
    strip(-c, 0.0, -1.0, 0.0);
    strip(1.0, 0.0, c, 0.0);
  }
}

}  // namespace evenglow::tests

#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "tests/support/film_bins.h"

/// What every specular film owes, at many incidences from both sides.
namespace evenglow::tests {

/// Directions of travel from both sides, up to 89 degrees.
inline std::vector<core::Vec3> many_directions() {
  std::vector<core::Vec3> all;
  for (const double sigma : {0.0, 5.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0}) {
    for (const double azimuth : {0.0, 17.0, 45.0, 90.0, 133.0, 200.0, 301.0}) {
      for (const bool up : {false, true}) all.push_back(travel(sigma, azimuth, up));
    }
  }
  return all;
}

/// Largest T + R over all polarizations of the incident light: of a row (a, b) the largest is a + |b|.
inline double greatest_energy(const tracer::Bsdf::Specular& s) {
  const Eigen::RowVector4d row = s.transmission.row(0) + s.reflection.row(0);
  return row[0] + row.tail<3>().norm();
}

/// Physical matrices, no gain, reciprocity. Reversed light of the same line of travel has the same tangential lines,
/// and V counted the other way: M of the reversed ray is O M^T O with O = diag(1, 1, 1, -1).
inline void expect_passive_and_reciprocal(const tracer::Bsdf& film) {
  const Eigen::Vector4d o(1, 1, 1, -1);
  for (const core::Vec3& k : many_directions()) {
    SCOPED_TRACE(testing::Message() << "k " << k.transpose());
    const auto s = film.specular(k);
    EXPECT_TRUE(core::is_physical(s.transmission));
    EXPECT_TRUE(core::is_physical(s.reflection));
    EXPECT_LE(greatest_energy(s), 1.0 + 1e-12);
    const auto through = film.specular(-k).transmission;
    EXPECT_TRUE(through.isApprox(o.asDiagonal() * s.transmission.transpose() * o.asDiagonal(), 1e-9));
    const auto back = film.specular({-k.x(), -k.y(), k.z()}).reflection;
    EXPECT_LT((back - core::MuellerMatrix(o.asDiagonal() * s.reflection.transpose() * o.asDiagonal())).norm(), 1e-9);
  }
}

/// Light after a straight passage of the film, in the tangential frame of the ray.
inline core::StokesVector passed(const tracer::Bsdf& film, const core::StokesVector& light) {
  const auto frame = tracer::tangential_frame(light.frame.k);
  return tracer::from_film(film.specular(light.frame.k).transmission * tracer::to_film(light, frame), frame);
}

}  // namespace evenglow::tests

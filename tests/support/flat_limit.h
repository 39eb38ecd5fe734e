#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/bumps.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"
#include "tracer/optics/dielectric_face.h"

namespace evenglow::tests {

/// A structure of vanishing height is the flat face: direction within `blur`, odds and polarization of every kind of
/// light, from both sides, with and without total reflection. False alarm 1e-3.
inline void expect_flat_face(const std::string& keys, double blur) {
  constexpr double kIndex = 1.5;
  constexpr int kPhotons = 4000;
  const auto optics = optics_of(keys, kIndex);
  const tracer::DielectricFace face(kIndex, 1.0);
  const double limit = z_limit(1e-3, 2 * 4 * 5);
  std::uint32_t stream = 0;
  for (const bool up : {true, false}) {
    for (const double degrees : {0.0, 25.0, 50.0, 70.0}) {
      const core::Vec3 k = travel(degrees, 77.0, up);
      for (const core::StokesVector& light : test_lights(k)) {
        const tracer::Bsdf::Specular split = face.specular(k);
        const Eigen::Vector4d s = tracer::to_film(light, tracer::tangential_frame(k));
        const Eigen::Vector4d reflected = split.reflection * s, transmitted = split.transmission * s;
        core::PhotonRng rng({20261122, ++stream, 0}, 0);
        int back = 0;
        for (int i = 0; i < kPhotons; ++i) {
          const auto out = optics->sample(light, rng);
          ASSERT_TRUE(out && out->specular) << keys;
          const core::Vec3& k_out = out->light.frame.k;
          const bool returned = (k_out.z() > 0.0) != up;
          back += returned ? 1 : 0;
          const double ratio = returned ? 1.0 : up ? kIndex : 1.0 / kIndex;
          ASSERT_NEAR(k_out.x(), ratio * k.x(), blur) << keys << " " << degrees;
          ASSERT_NEAR(k_out.y(), ratio * k.y(), blur) << keys << " " << degrees;
          if (degrees < 1.0) continue;  // the tangential frame of a ray near the normal turns with its rest of tilt
          const Eigen::Vector4d expected = returned ? reflected : transmitted;
          const Eigen::Vector4d got = tracer::to_film(out->light, tracer::tangential_frame(k_out));
          ASSERT_NEAR((got - expected / expected[0]).norm(), 0.0, 20.0 * blur) << keys << " " << degrees << " " << up;
        }
        EXPECT_LT(std::abs(binomial_z(back, kPhotons, std::min(reflected[0], 1.0))), limit)
            << keys << " " << degrees << " " << up;
      }
    }
  }
}

}  // namespace evenglow::tests

#include "tracer/optics/volume_scattering.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

/// Limits are 4.5 standard errors: false alarm 7e-6 a comparison. Seeds fixed.
namespace evenglow::tracer {
namespace {

constexpr int kCount = 200000;

TEST(VolumeScattering, MeanCosineIsTheAnisotropy) {
  for (const double g : {-0.5, 0.0, 0.00005, 0.5, 0.9, 0.99}) {
    double sum = 0.0, squares = 0.0;
    core::PhotonRng rng({1, 0, 0}, 0);
    for (int i = 0; i < kCount; ++i) {
      const double c = henyey_greenstein_cosine(g, rng.uniform());
      sum += c;
      squares += c * c;
    }
    const double mean = sum / kCount;
    const double se = std::sqrt((squares / kCount - mean * mean) / kCount);
    EXPECT_NEAR(mean, g, 4.5 * se) << g;
    // Second Legendre moment g^2.
    const double p2 = 1.5 * squares / kCount - 0.5;
    EXPECT_NEAR(p2, g * g, 4.5 * 1.5 / std::sqrt(kCount)) << g;
  }
}

TEST(VolumeScattering, CosineInvertsTheDistribution) {
  // Cumulative share up to a cosine c, from the integral of the phase function.
  for (const double g : {-0.7, 0.3, 0.9}) {
    for (const double u : {0.01, 0.3, 0.8, 0.999}) {
      const double c = henyey_greenstein_cosine(g, u);
      const double share = (1.0 - g * g) / (2.0 * g) * (1.0 / std::sqrt(1.0 + g * g - 2.0 * g * c) - 1.0 / (1.0 + g));
      EXPECT_NEAR(share, u, 1e-12);
    }
  }
}

TEST(VolumeScattering, FreePathIsExponential) {
  const VolumeScattering bulk{5.0, 0.9, 1.0};
  core::PhotonRng rng({2, 0, 0}, 0);
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) sum += bulk.free_path(rng);
  EXPECT_NEAR(sum / kCount, 0.2, 4.5 * 0.2 / std::sqrt(kCount));
}

TEST(VolumeScattering, FramesStayOrthonormalAndPolarizationShrinks) {
  const VolumeScattering bulk{1.0, 0.3, 0.25};
  core::PhotonRng rng({3, 0, 0}, 0);
  core::StokesVector light{1.0, 0.6, 0.0, 0.8, core::PolarizationFrame::any(core::Vec3(1.0, 2.0, 2.0) / 3.0)};
  double kept = 1.0;
  for (int i = 0; i < 10; ++i) {
    light = bulk.scatter(light, rng);
    kept *= 0.75;
    EXPECT_NEAR(light.frame.k.norm(), 1.0, 1e-12);
    EXPECT_NEAR(light.frame.e1.norm(), 1.0, 1e-12);
    EXPECT_NEAR(light.frame.k.dot(light.frame.e1), 0.0, 1e-12);
    EXPECT_NEAR(std::sqrt(light.Q * light.Q + light.U * light.U + light.V * light.V), kept, 1e-12);
    EXPECT_EQ(light.I, 1.0);
  }
}

TEST(VolumeScattering, TheFieldIsCarriedAlongTheGreatCircle) {
  // e1 in the plane of the turn stays in it; e1 across stays as it is. Both follow from: the axis of the turn, k x k',
  // keeps its angle to the field.
  const VolumeScattering bulk{1.0, 0.0, 0.0};
  core::PhotonRng rng({4, 0, 0}, 0);
  const core::StokesVector light{1.0, 1.0, 0.0, 0.0, core::PolarizationFrame::any(core::Vec3::UnitZ())};
  for (int i = 0; i < 100; ++i) {
    const core::StokesVector out = bulk.scatter(light, rng);
    const core::Vec3 axis = light.frame.k.cross(out.frame.k).normalized();
    EXPECT_NEAR(axis.dot(light.frame.e1), axis.dot(out.frame.e1), 1e-9);
  }
}

}  // namespace
}  // namespace evenglow::tracer

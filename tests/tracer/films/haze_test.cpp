#include "tracer/films/haze.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/films.h"
#include "tests/support/z_test.h"
#include "tracer/films/diffuser.h"

namespace evenglow::tracer {
namespace {

using tests::kRad;

/// Far from the horizon the lobe is a plain Gaussian: exp(-sin^2(2.5 degrees) / 2 s^2) lies beyond.
TEST(Haze, OfANarrowLobeIsThatOfAGaussian) {
  for (const double fwhm : {1.0, 2.0, 5.0, 10.0}) {
    const double s = Diffuser::lobe_width(fwhm * kRad);
    const double expected = std::exp(-std::pow(std::sin(2.5 * kRad) / s, 2) / 2.0);
    EXPECT_NEAR(gaussian_haze(fwhm * kRad), expected, 1e-5) << fwhm;
  }
}

/// False alarm 1e-4 in all. Seeds fixed.
TEST(Haze, IsWhatPhotonsSay) {
  const double limit = tests::z_limit(1e-4, 3);
  for (const double fwhm : {3.0, 20.0, 120.0}) {
    const Diffuser film({1.0, 0.0, 1.0, fwhm * kRad, 0.0});
    const auto light = core::StokesVector::unpolarized(1.0, tangential_frame(core::Vec3::UnitZ()).frame);
    constexpr int kPhotons = 100000;
    int beyond = 0;
    for (int i = 0; i < kPhotons; ++i) {
      core::PhotonRng rng({8, 0, 0}, static_cast<std::uint64_t>(i));
      beyond += film.sample(light, rng)->light.frame.k.z() < std::cos(2.5 * kRad);
    }
    EXPECT_LT(std::abs(tests::binomial_z(beyond, kPhotons, gaussian_haze(fwhm * kRad))), limit) << fwhm;
  }
}

TEST(Haze, WidthsComeBack) {
  for (const double fwhm : {1.5, 4.0, 30.0, 140.0}) {
    const auto found = fwhm_of_haze(gaussian_haze(fwhm * kRad));
    ASSERT_TRUE(found);
    EXPECT_NEAR(gaussian_haze(*found), gaussian_haze(fwhm * kRad), 1e-7);
    EXPECT_NEAR(*found / kRad, fwhm, 1e-3 * fwhm);
  }
  EXPECT_FALSE(fwhm_of_haze(0.9999));
  EXPECT_FALSE(fwhm_of_haze(0.0));
}

}  // namespace
}  // namespace evenglow::tracer

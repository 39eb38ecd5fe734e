#include "tracer/films/specular_film.h"

#include <gtest/gtest.h>

#include "tests/support/films.h"
#include "tests/support/specular_checks.h"
#include "tests/support/z_test.h"

namespace evenglow::tracer {
namespace {

using tests::travel;

/// Passes 0.5 and turns U to V, reflects 0.2 of e1 light alone, absorbs the rest.
class Sample final : public SpecularFilm {
  Specular matrices(const TangentialFrame&) const override {
    return {0.5 * core::retarder(-0.5 * core::kPi), core::diattenuator(0.2, 0.0)};
  }
};

TEST(SpecularFilm, ScattersNothing) {
  const Sample film;
  EXPECT_FALSE(film.scatters());
  const auto light = core::StokesVector::unpolarized(1, tangential_frame(travel(10, 0)).frame);
  EXPECT_EQ(film.evaluate(light, travel(20, 0)).I, 0.0);
}

TEST(SpecularFilm, SamplesItsMatrices) {
  const Sample film;
  const core::Vec3 k = travel(35, 70, true);
  const auto frame = tangential_frame(k);
  const core::StokesVector light = from_film({2.0, 1.0, 1.0, 0.0}, frame);
  core::PhotonRng rng({5, 0, 0}, 0);
  double through = 0, back = 0;
  constexpr int kSamples = 100000;
  for (int i = 0; i < kSamples; ++i) {
    const auto out = film.sample(light, rng);
    if (!out) continue;
    ASSERT_TRUE(out->specular);
    ASSERT_NEAR(out->light.I, 2.0, 1e-12);
    const auto s = to_film(out->light, tangential_frame(out->light.frame.k));
    if (out->light.frame.k.z() > 0) {
      ++through;
      ASSERT_TRUE(s.isApprox(Eigen::Vector4d(2.0, 1.0, 0.0, 1.0), 1e-12)) << s.transpose();
      ASSERT_TRUE(out->light.frame.k.isApprox(k));
    } else {
      ++back;
      ASSERT_TRUE(s.isApprox(Eigen::Vector4d(2.0, 2.0, 0.0, 0.0), 1e-12)) << s.transpose();
    }
  }
  const double limit = tests::z_limit(1e-3, 2);
  EXPECT_LT(std::abs(tests::binomial_z(through, kSamples, 0.5)), limit);
  EXPECT_LT(std::abs(tests::binomial_z(back, kSamples, 0.15)), limit);
}

TEST(SpecularFilm, TurnedIsRotatedMatrixRotatedBack) {
  const double chi = 0.7;
  const core::MuellerMatrix M = core::diattenuator(0.9, 0.1) * core::retarder(0.4);
  EXPECT_TRUE(
      turned(M, {std::cos(2 * chi), std::sin(2 * chi)}).isApprox(core::rotator(-chi) * M * core::rotator(chi), 1e-14));
}

}  // namespace
}  // namespace evenglow::tracer

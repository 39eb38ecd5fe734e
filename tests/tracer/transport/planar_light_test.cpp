#include "tracer/transport/planar_light.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/plate_light.h"
#include "tracer/optics/dielectric_face.h"

/// Held against the general Stokes vectors and smooth face.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

constexpr double kIndex = 1.49;

/// Polarized light of any direction, its frame turned at random.
StokesVector random_light(core::PhotonRng& rng) {
  const Vec3 k = random_direction(rng);
  StokesVector light = StokesVector::linear(1.0, 2.0 * core::kPi * rng.uniform(), core::PolarizationFrame::any(k));
  const double share = rng.uniform();
  light.Q *= share;
  light.U *= share;
  light.V = 0.5 * (1.0 - share);
  return light;
}

void expect_same(const StokesVector& a, const StokesVector& b) {
  const StokesVector c = b.in_frame(a.frame.e1);
  EXPECT_LT((a.frame.k - b.frame.k).norm(), 1e-12);
  EXPECT_NEAR(a.Q, c.Q, 1e-11);
  EXPECT_NEAR(a.U, c.U, 1e-11);
  EXPECT_NEAR(a.V, c.V, 1e-11);
}

TEST(MeridianLight, ThereAndBack) {
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 1000; ++i) {
    const StokesVector light = random_light(rng);
    expect_same(MeridianLight(light).stokes(), light);
  }
  const StokesVector up = StokesVector::linear(1.0, 0.3, core::PolarizationFrame::any(Vec3::UnitZ()));
  expect_same(MeridianLight(up).stokes(), up);
}

/// The light that `face`, with its normal along +z of a frame turned so that z is `axis`, reflects totally.
StokesVector reflected_by_face(const StokesVector& light, int axis, core::PhotonRng& rng) {
  const auto turn = [](const Vec3& v, int by) { return Vec3(v[by % 3], v[(1 + by) % 3], v[(2 + by) % 3]); };
  const int there = (axis + 1) % 3;  // brings the component `axis` to z
  const int back = (3 - there) % 3;
  const StokesVector local{1.0, light.Q, light.U, light.V, {turn(light.frame.k, there), turn(light.frame.e1, there)}};
  const DielectricFace face(kIndex, kIndex > 1.0 && local.frame.k.z() > 0.0 ? 1.0 : kIndex);
  const DielectricFace below(1.0, kIndex);
  const auto sample = (local.frame.k.z() > 0.0 ? face : below).sample(local, rng);
  const StokesVector& s = sample->light;
  return {1.0, s.Q, s.U, s.V, {turn(s.frame.k, back), turn(s.frame.e1, back)}};
}

bool is_total(const StokesVector& light, int axis) {
  return PlateFresnel(std::abs(light.frame.k[axis]), kIndex, 1.0).total;
}

TEST(MeridianLight, TotalReflectionAtFacesAndWalls) {
  core::PhotonRng rng({2, 0, 0}, 0);
  int tried = 0;
  for (int i = 0; i < 3000; ++i) {
    const StokesVector light = random_light(rng);
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_total(light, axis)) continue;
      ++tried;
      MeridianLight mine(light);
      double& kn = axis == 0 ? mine.kx : axis == 1 ? mine.ky : mine.kz;
      const PlateFresnel face(std::abs(kn), kIndex, 1.0);
      const double kt = axis == 0 ? mine.ky : mine.kx;
      const WallTurn turn = axis < 2 ? WallTurn(kn, kt, mine.kz, axis == 0 ? 1.0 : -1.0) : WallTurn(0.0, 0.0, 0.0, 1.0);
      mine.turn_frame(turn.cos2, turn.sin2);
      mine.turn_phase(face.phase_re, face.phase_im);
      mine.turn_frame(turn.cos2, turn.sin2);
      kn = -kn;
      expect_same(mine.stokes(), reflected_by_face(light, axis, rng));
    }
  }
  EXPECT_GT(tried, 1000);
}

TEST(MeridianLight, ManyReflectionsInOneStep) {
  core::PhotonRng rng({3, 0, 0}, 0);
  const PlateFresnel face(0.3, kIndex, 1.0);
  ASSERT_TRUE(face.total);
  EXPECT_NEAR(std::hypot(face.phase_re, face.phase_im), 1.0, 1e-15);
  for (const int count : {0, 1, 2, 3, 7, 64, 1001}) {
    MeridianLight at_once(random_light(rng));
    MeridianLight one_by_one = at_once;
    at_once.reflect_totally(face.phase_re, face.phase_im, count);
    for (int i = 0; i < count; ++i) one_by_one.turn_phase(face.phase_re, face.phase_im);
    EXPECT_NEAR(at_once.Q, one_by_one.Q, 1e-15) << count;
    EXPECT_NEAR(at_once.U, one_by_one.U, 1e-12) << count;
    EXPECT_NEAR(at_once.V, one_by_one.V, 1e-12) << count;
  }
}

/// tan(d/2) = cos i sqrt(sin^2 i - n^2) / sin^2 i, d = arg r_s - arg r_p (docs/conventions.md).
TEST(PlateFresnel, PhaseOfTotalReflection) {
  for (double c = 0.02; c < 0.74; c += 0.05) {
    const PlateFresnel face(c, kIndex, 1.0);
    ASSERT_TRUE(face.total) << c;
    const double sin2 = 1.0 - c * c;
    const double n = 1.0 / kIndex;
    const double d = 2.0 * std::atan(c * std::sqrt(sin2 - n * n) / sin2);
    EXPECT_NEAR(face.phase_re, std::cos(d), 1e-12) << c;
    EXPECT_NEAR(face.phase_im, -std::sin(d), 1e-12) << c;
  }
}

/// Partial reflection and refraction against the general face: mean shares, and the light of each kind.
TEST(PlateFresnel, PartialReflection) {
  core::PhotonRng rng({4, 0, 0}, 0);
  const DielectricFace general(kIndex, 1.0);
  int tried = 0;
  while (tried < 500) {
    StokesVector light = random_light(rng);
    if (light.frame.k.z() <= 0.0 || is_total(light, 2)) continue;
    ++tried;
    const auto sample = general.sample(light, rng);
    MeridianLight mine(light);
    const PlateFresnel face(mine.kz, kIndex, 1.0);
    const Bsdf::Specular s = general.specular(light.frame.k);
    const TangentialFrame frame = tangential_frame(light.frame.k);
    // It is reflected by numbers just below its odds, and not by those above.
    const double sums = face.p_sum * face.s_sum, whole = sums * sums;
    const double odds = s.reflection.row(0).dot(to_film(light, frame));
    MeridianLight reflected = mine;
    EXPECT_FALSE(reflected.scales_amplitudes(face.p_reflected, face.s_reflected, whole, odds + 1e-12));
    EXPECT_EQ(reflected.Q, mine.Q);
    ASSERT_TRUE(reflected.scales_amplitudes(face.p_reflected, face.s_reflected, whole, odds - 1e-12));
    if (sample->light.frame.k.z() < 0.0) {
      mine = reflected;
      mine.kz = -mine.kz;
    } else {
      face.pass(mine);
      mine.kx *= kIndex;
      mine.ky *= kIndex;
      mine.kz = face.cos_t;
    }
    expect_same(mine.stokes(), sample->light);
  }
}

}  // namespace
}  // namespace evenglow::tests

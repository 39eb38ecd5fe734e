#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/math/vec3.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// A bare lossless slab with n > sqrt 2, natural Lambertian light in air at its end face: nothing may leave its other
/// faces but the far end, and what leaves that end is known from a computation of its own: rays with complex field
/// vectors, everything written out here, nothing of the tracer. Seeds fixed.
namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::Side;
using Complex = std::complex<double>;
using Field = Eigen::Vector3cd;

constexpr double kIndex = 1.4938;
const Vec3 kSize(6.0, 4.0, 2.5);

/// Field reflected by the inner side of a face with unit normal along `axis`; k is mirrored. `phases`: with the phases
/// of total reflection, or as an ideal mirror would have it.
Field reflected(const Field& E, const Vec3& k, int axis, bool phases) {
  const Vec3 normal = Vec3::Unit(axis);
  const Vec3 cross = k.cross(normal);
  const double sin_i = cross.norm();
  const Vec3 s = sin_i > 1e-12 ? Vec3(cross / sin_i) : Vec3(Vec3::Unit((axis + 1) % 3));
  Vec3 k_out = k;
  k_out[axis] = -k[axis];
  const double cos_i = std::abs(k[axis]);
  Complex rs = -1.0, rp = 1.0;
  if (phases || kIndex * sin_i < 1.0) {
    const Complex cos_t =
        std::sqrt(Complex(1.0 - kIndex * kIndex * sin_i * sin_i, 0.0));  // + i: decays with exp(-i w t)
    rs = (kIndex * cos_i - cos_t) / (kIndex * cos_i + cos_t);
    rp = (cos_i - kIndex * cos_t) / (cos_i + kIndex * cos_t);
  }
  const Vec3 p_in = s.cross(k), p_out = s.cross(k_out);
  return rs * s.cast<Complex>().dot(E) * s.cast<Complex>() + rp * p_in.cast<Complex>().dot(E) * p_out.cast<Complex>();
}

/// Shares of one ray's light (unit power inside at `p`, field E) that leave by the near and the far end.
std::array<double, 2> ends_of_ray(Vec3 p, Vec3 k, Field E, bool phases) {
  std::array<double, 2> left{0.0, 0.0};
  double power = 1.0;
  while (power > 1e-9) {
    int axis = 0;
    double t = 1e300;
    for (int i = 0; i < 3; ++i) {
      const double ti = ((k[i] > 0.0 ? kSize[i] : 0.0) - p[i]) / k[i];
      if (k[i] != 0.0 && ti < t) {
        t = ti;
        axis = i;
      }
    }
    p += t * k;
    p[axis] = k[axis] > 0.0 ? kSize[axis] : 0.0;
    E = reflected(E, k, axis, phases);
    const double kept = E.squaredNorm();
    left[axis == 0 && k[0] > 0.0 ? 1 : 0] += power - kept;
    power = kept;
    k[axis] = -k[axis];
  }
  return left;
}

struct EndShares {
  core::Estimate near, far;
};

/// Points and directions from a lattice in four dimensions (Roberts' R sequence), moved at random 16 times (for the
/// error).
EndShares lattice_sum(int points, bool phases) {
  constexpr int kShifts = 16;
  double g = 1.2;  // root of x^5 = x + 1
  for (int i = 0; i < 50; ++i) g = std::pow(1.0 + g, 0.2);
  double sum[2] = {0, 0}, squares[2] = {0, 0};
  std::uint64_t state = 88172645463325252ULL;
  for (int shift = 0; shift < kShifts; ++shift) {
    double at[4];
    for (double& x : at) {  // xorshift64
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      x = static_cast<double>(state >> 11) * 0x1.0p-53;
    }
    double mean[2] = {0, 0};
    for (int i = 0; i < points; ++i) {
      double u[4];
      for (int d = 0; d < 4; ++d) u[d] = std::fmod(at[d] + i * std::pow(g, -(d + 1)), 1.0);
      const double sin_i = std::sqrt(u[0]), cos_i = std::sqrt(1.0 - u[0]), azimuth = 2.0 * core::kPi * u[1];
      const Vec3 h(0.0, std::cos(azimuth), std::sin(azimuth));
      const double cos_t = std::sqrt(1.0 - sin_i * sin_i / (kIndex * kIndex));
      const Vec3 k = cos_t * Vec3::UnitX() + sin_i / kIndex * h;
      const Vec3 s = Vec3::UnitX().cross(h);
      const double rs = (cos_i - kIndex * cos_t) / (cos_i + kIndex * cos_t);
      const double rp = (kIndex * cos_i - cos_t) / (kIndex * cos_i + cos_t);
      const Vec3 p(0.0, u[2] * kSize.y(), u[3] * kSize.z());
      // Natural light: half s, half p, with their own transmittances.
      for (const auto& [R, e] : {std::pair{rs * rs, s}, std::pair{rp * rp, Vec3(s.cross(k))}}) {
        const auto ends = ends_of_ray(p, k, e.cast<Complex>(), phases);
        mean[0] += 0.5 * (R + (1.0 - R) * ends[0]) / points;
        mean[1] += 0.5 * (1.0 - R) * ends[1] / points;
      }
    }
    for (int e = 0; e < 2; ++e) {
      sum[e] += mean[e] / kShifts;
      squares[e] += mean[e] * mean[e] / kShifts;
    }
  }
  const auto estimate = [&](int e) {
    return core::Estimate{sum[e], std::sqrt(std::max(0.0, squares[e] - sum[e] * sum[e]) / (kShifts - 1))};
  };
  return {estimate(0), estimate(1)};
}

/// z of counted shares against the lattice sum, both errors in it.
void check_slab(std::uint64_t photons, int points, int threads) {
  const Traced traced(
      "light_guide_plate: {length_mm: 6, width_mm: 4, thickness_mm: 2.5, refractive_index: 1.4938}, "
      "sources: [{kind: lambertian_face, face: left}], receivers: [{kind: flux}]",
      {photons, 1, 10, threads});
  for (const Side side : {Side::kFront, Side::kBack, Side::kBottom, Side::kTop}) EXPECT_EQ(traced.escaped(side), 0.0);
  EXPECT_EQ(traced.escaped(Side::kLeft) + traced.escaped(Side::kRight), traced.photons());
  const EndShares with = lattice_sum(points, true), without = lattice_sum(points, false);
  const double n = traced.photons();
  const double far = traced.escaped(Side::kRight) / n;
  const double se = std::sqrt(far * (1.0 - far) / n);
  EXPECT_NEAR(with.near.value + with.far.value, 1.0, 1e-7);
  EXPECT_LT(with.far.se, 0.3 * se);
  // 3 standard errors: false alarm 0.0027.
  EXPECT_LT(std::abs(far - with.far.value), 3.0 * std::hypot(se, with.far.se))
      << far << " +- " << se << " for " << with.far.value;
  // Total reflection as a perfect mirror: wrong by about 0.4 % of the flux, and seen here.
  const double error = std::abs(without.far.value / with.far.value - 1.0);
  EXPECT_GT(error, 0.002);
  EXPECT_LT(error, 0.008);
  EXPECT_GT(std::abs(far - without.far.value), 5.0 * std::hypot(se, without.far.se));
  std::printf("far end: traced %.6f +- %.6f, rays with phases %.6f +- %.6f, without %.6f +- %.6f\n", far, se,
              with.far.value, with.far.se, without.far.value, without.far.se);
}

TEST(BareSlab, NothingLeavesItsSidesAndTheEndsAreRight) {
  check_slab(1'000'000, 20'000, 1);
}
TEST(BareSlabLong, NothingLeavesItsSidesAndTheEndsAreRight) {
  check_slab(40'000'000, 1'000'000, 0);
}

/// No side face leaks over a wide range of sizes and indices above sqrt 2, down to the last photon.
TEST(BareSlab, SideFacesAreDark) {
  for (const char* plate : {"length_mm: 140, width_mm: 66, thickness_mm: 0.6, refractive_index: 1.4938",
                            "length_mm: 20, width_mm: 0.3, thickness_mm: 0.3, refractive_index: 1.4143",
                            "length_mm: 1, width_mm: 50, thickness_mm: 20, refractive_index: 2.2"}) {
    const Traced traced(
        std::string("light_guide_plate: {") + plate + "}, sources: [{kind: lambertian_face, face: left, gap_mm: 0}]",
        {20'000, 2, 10, 1});
    EXPECT_EQ(traced.escaped(Side::kLeft) + traced.escaped(Side::kRight), traced.photons()) << plate;
  }
}

}  // namespace
}  // namespace evenglow::tests

#include "tracer/films/scattering_sheet.h"

#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/z_test.h"

/// Counts against transport theory. Chance of a false alarm 1e-4 for each test, all its comparisons together. Seeds
/// fixed.
namespace evenglow::tracer {
namespace {

using tests::travel;

constexpr double kNoFaces = 1.0000001;  // an index whose faces do nothing

DielectricSheet sheet(double depth, double g, double index = kNoFaces, double absorption = 0.0) {
  return {index, absorption, 1.0, VolumeScattering{depth, g, 1.0}};
}

struct Shares {
  double n = 0.0, through = 0.0, straight = 0.0, back = 0.0;
};

/// `cosine` of the incidence; 0: Lambertian light.
Shares traced(const DielectricSheet& what, double cosine, int photons) {
  const ScatteringSheet film(what);
  Shares shares;
  shares.n = photons;
  for (int i = 0; i < photons; ++i) {
    core::PhotonRng rng({11, 0, 0}, static_cast<std::uint64_t>(i));
    const double c = cosine > 0.0 ? cosine : std::sqrt(rng.uniform());
    const core::Vec3 k(std::sqrt(1.0 - c * c), 0.0, -c);
    const auto out = film.sample(core::StokesVector::unpolarized(1.0, tangential_frame(k).frame), rng);
    if (!out) continue;
    if (out->light.frame.k.z() > 0.0) {
      shares.back += 1.0;
    } else {
      shares.through += 1.0;
      shares.straight += (out->light.frame.k - k).norm() < 1e-9;
    }
  }
  return shares;
}

double e1(double x) {
  return -std::expint(-x);
}
double e2(double x) {
  return x > 0.0 ? std::exp(-x) - x * e1(x) : 1.0;
}
double e3(double x) {
  return 0.5 * (std::exp(-x) - x * e2(x));
}

/// Total transmittance of a slab that scatters isotropically and absorbs nothing, by the Schwarzschild-Milne equation
/// for the light q scattered per optical depth (Chandrasekhar, Radiative Transfer, 1950; van de Hulst, Multiple Light
/// Scattering, 1980)
///
///     q(t) = q_0(t) + 1/2 integral E_1(|t - t'|) q(t') dt',    T = T_0 + 1/2 integral E_2(depth - t) q(t) dt
///
/// in cells of constant q, whose kernel has closed means. Beam: T_0 = exp(-depth / c); Lambertian: T_0 = 2 E_3(depth).
double milne(double depth, double cosine) {
  constexpr int n = 400;
  const double h = depth / n;
  const auto straight = [&](double t) { return cosine > 0.0 ? std::exp(-t / cosine) : 2.0 * e3(t); };
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    b[i] = (straight(i * h) - straight((i + 1) * h)) / h;
    for (int j = 0; j < n; ++j) {
      const double d = std::abs(i - j) * h;
      // Mean over cell i of the integral over cell j: second difference of E_3.
      A(i, j) -= i == j ? 1.0 - (0.5 - e3(h)) / h : 0.5 * (e3(d + h) - 2.0 * e3(d) + e3(d - h)) / h;
    }
  }
  const Eigen::VectorXd q = A.partialPivLu().solve(b);
  double T = straight(depth);
  for (int i = 0; i < n; ++i) T += 0.5 * q[i] * (e3(depth - (i + 1) * h) - e3(depth - i * h));
  return T;
}

TEST(ScatteringSheet, StraightLightFollowsBeerAndLambert) {
  const double limit = tests::z_limit(1e-4, 6);
  for (const double depth : {0.3, 1.0, 3.0}) {
    for (const double cosine : {1.0, 0.5}) {
      const Shares s = traced(sheet(depth, 0.9), cosine, 50000);
      EXPECT_LT(std::abs(tests::binomial_z(s.straight, s.n, std::exp(-depth / cosine))), limit) << depth << cosine;
    }
  }
}

/// The independent computation against the printed table: heat flux between black walls through a gray medium
/// (Heaslet and Warming, Int. J. Heat Mass Transfer 8, 1965), which is T for Lambertian light.
TEST(ScatteringSheet, TheIntegralEquationAgreesWithThePrintedValues) {
  for (const auto& [depth, printed] :
       {std::pair{0.1, 0.9157}, {0.5, 0.7040}, {1.0, 0.5534}, {2.0, 0.3901}, {3.0, 0.3016}, {5.0, 0.2077}}) {
    EXPECT_NEAR(milne(depth, 0.0), printed, 3e-4) << depth;
  }
}

TEST(ScatteringSheet, IsotropicSlabsTransmitAsTransportTheorySays) {
  const double limit = tests::z_limit(1e-4, 9);
  for (const double depth : {1.0, 2.0, 4.0}) {
    for (const double cosine : {0.0, 1.0, 0.4}) {
      const Shares s = traced(sheet(depth, 0.0), cosine, 40000);
      EXPECT_LT(std::abs(tests::binomial_z(s.through, s.n, milne(depth, cosine))), limit) << depth << " " << cosine;
    }
  }
}

/// Diffusion: T = (4/3) / (depth + 2 x 0.7104) for Lambertian light on a thick slab (Milne's extrapolation length).
TEST(ScatteringSheet, ThickSlabsReachDiffusion) {
  const Shares s = traced(sheet(20.0, 0.0), 0.0, 40000);
  EXPECT_LT(std::abs(tests::binomial_z(s.through, s.n, 4.0 / 3.0 / (20.0 + 2 * 0.710446))), tests::z_limit(1e-4, 1));
}

/// Forward scattering of depth t acts as isotropic scattering of depth (1 - g) t (van de Hulst's similarity), to 3 %.
TEST(ScatteringSheet, ForwardScatteringIsSimilarToLessIsotropic) {
  for (const double g : {0.5, 0.8, -0.3}) {
    const Shares s = traced(sheet(8.0 / (1.0 - g), g), 0.0, 40000);
    const double expected = milne(8.0, 0.0);
    EXPECT_NEAR(s.through / s.n, expected, 0.03 * expected + 4.0 * std::sqrt(expected / s.n)) << g;
  }
}

TEST(ScatteringSheet, LosesNothingWithoutAbsorption) {
  for (const double index : {kNoFaces, 1.5}) {
    const Shares s = traced(sheet(5.0, 0.7, index), 0.6, 20000);
    EXPECT_EQ(s.through + s.back, s.n);
  }
}

/// Slab of index n whose faces take what transport between them gives back: faces of Lambertian light, outer
/// reflectance r_e and inner one r_i = 1 - (1 - r_e) / n^2; for a thick slab the light between them is Lambertian to a
/// few percent, T = (1 - r_e) t / (1 - r_i (2 r + ...)) summed as plates.
TEST(ScatteringSheet, FacesHoldLightBack) {
  const double n = 1.5;
  double outer = 0.0;  // of Lambertian light
  for (int i = 0; i < 20000; ++i) {
    const double c = std::sqrt((i + 0.5) / 20000);
    outer += DielectricFace(1.0, n).specular({std::sqrt(1 - c * c), 0, c}).reflection(0, 0) / 20000;
  }
  const double inner = 1.0 - (1.0 - outer) / (n * n);
  const double t = milne(20.0, 0.0), r = 1.0 - t;
  // Slab and far face, then the near face.
  const double many = 1.0 - r * inner;
  const double t2 = t * (1.0 - inner) / many, r2 = r + t * t * inner / many;
  const double expected = (1.0 - outer) * t2 / (1.0 - inner * r2);
  const Shares s = traced(sheet(20.0, 0.0, n), 0.0, 40000);
  EXPECT_NEAR(s.through / s.n, expected, 0.05 * expected);
}

TEST(ScatteringSheet, StraightLightThroughFacesIsThatOfAnAbsorber) {
  const ScatteringSheet film(sheet(1.5, 0.8, 1.6, 0.2));
  const auto expected = incoherent_sheet(0.7, 1.6, 1.7, 1.0);
  const core::Vec3 k(std::sqrt(1 - 0.49), 0, 0.7);
  EXPECT_EQ(film.specular(k).transmission, expected.transmission);
  const Shares s = traced(sheet(1.5, 0.8, 1.6, 0.2), 0.7, 50000);
  EXPECT_LT(std::abs(tests::binomial_z(s.straight, s.n, expected.transmission(0, 0))), tests::z_limit(1e-4, 1));
  EXPECT_LT(s.through + s.back, s.n);
}

TEST(ScatteringSheet, PolarizationIsWhatScattersLeave) {
  // No depolarization at all: fully polarized light stays so. Depolarization 1: what is scattered is natural.
  for (const double depolarization : {0.0, 1.0}) {
    DielectricSheet what = sheet(2.0, 0.9, 1.5);
    what.scattering->depolarization = depolarization;
    const ScatteringSheet film(what);
    for (int i = 0; i < 200; ++i) {
      core::PhotonRng rng({12, 0, 0}, static_cast<std::uint64_t>(i));
      const core::Vec3 k = travel(0, 0);
      const auto out = film.sample(core::StokesVector::linear(1.0, 0.3, tangential_frame(k).frame), rng);
      ASSERT_TRUE(out);
      EXPECT_NEAR(out->light.I, 1.0, 1e-12);
      const bool straight = std::abs(out->light.frame.k.z()) > 1.0 - 1e-12;
      const double degree = out->light.degree_of_polarization();
      if (depolarization == 0.0 || straight) {
        EXPECT_NEAR(degree, 1.0, 1e-9);
      } else {
        EXPECT_LT(degree, 0.999);  // what the face polarizes on the way out
      }
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer

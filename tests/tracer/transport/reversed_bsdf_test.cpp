#include "tracer/transport/reversed_bsdf.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/scenes.h"
#include "tests/support/specular_checks.h"
#include "tests/support/z_test.h"
#include "tracer/optics/dielectric_face.h"

/// Seeds fixed; false alarm 1e-3 for each statistical test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

/// The rule of the header, on a face: what it does to reversed light is O M^T O, in right-handed frames; in the
/// tangential count the sign of U drops out and that of V stays.
TEST(ReversedBsdf, FacesAreReciprocal) {
  const DielectricFace face(1.5, 1.0);
  const Eigen::Vector4d o(1, 1, 1, -1);
  for (const Vec3& k : many_directions()) {
    const auto out = face.sample(
        StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), *[] {
          static core::PhotonRng rng({1, 0, 0}, 0);
          return &rng;
        }());
    const Vec3 k_out = out->light.frame.k;
    const bool passes = k_out.z() * k.z() > 0.0;
    const auto forward = face.specular(k), back = face.specular(-k_out);
    const core::MuellerMatrix M = passes ? forward.transmission : forward.reflection;
    const core::MuellerMatrix reverse = passes ? back.transmission : back.reflection;
    EXPECT_LT((reverse - core::MuellerMatrix(o.asDiagonal() * M.transpose() * o.asDiagonal())).norm(), 1e-9);
  }
}

TEST(ReversedBsdf, ReversedIsItsOwnInverse) {
  const StokesVector s{1.0, 0.3, -0.2, 0.4, core::PolarizationFrame::any(travel(40, 70, true))};
  const StokesVector r = reversed(s);
  EXPECT_EQ(r.frame.k, -s.frame.k);
  EXPECT_EQ(r.U, -s.U);
  EXPECT_EQ(r.V, s.V);
  EXPECT_EQ(reversed(r).U, s.U);
  EXPECT_EQ(reversed(r).frame.k, s.frame.k);
}

/// Directions within a cone about an axis, and their projected solid angle.
struct Cone {
  double polar_deg, azimuth_deg;
  bool up;
  double half_deg;

  Vec3 axis() const { return travel(polar_deg, azimuth_deg, up); }
  bool holds(const Vec3& k) const { return k.dot(axis()) >= std::cos(half_deg * core::kRadPerDeg); }
  /// For cones that keep above the horizon.
  double projected() const {
    const double s = std::sin(half_deg * core::kRadPerDeg);
    return core::kPi * s * s * std::abs(axis().z());
  }
  /// Density |cos| / `projected`: even over the cone, kept with the odds |cos|.
  Vec3 draw(core::PhotonRng& rng) const {
    const core::PolarizationFrame frame = core::PolarizationFrame::any(axis());
    while (true) {
      const double c = 1.0 - rng.uniform() * (1.0 - std::cos(half_deg * core::kRadPerDeg));
      const double s = std::sqrt(1.0 - c * c), phi = 2.0 * core::kPi * rng.uniform();
      const Vec3 k = (c * frame.k + s * std::cos(phi) * frame.e1 + s * std::sin(phi) * frame.e2()).normalized();
      if (rng.uniform() < std::abs(k.z())) return k;
    }
  }
};

/// Light and importance of these polarizations from the tangential frame.
struct Way {
  Cone in, out;
  Eigen::Vector4d light, importance;
};

/// What goes from one cone to another, forward by `sample`, and backward by `step_back`: both estimate
/// integral over both cones of (w . M s) d(projected) d(projected), for light and importance of given polarizations.
void expect_same_both_ways(const Bsdf& film, const std::vector<Way>& ways, int draws = 200'000) {
  core::PhotonRng rng({20260705, 0, 0}, 0);
  for (const Way& way : ways) {
    SCOPED_TRACE(testing::Message() << "in " << way.in.axis().transpose() << ", out " << way.out.axis().transpose());
    double forward = 0.0, forward2 = 0.0, backward = 0.0, backward2 = 0.0;
    for (int i = 0; i < draws; ++i) {
      const StokesVector light = from_film(way.light, tangential_frame(way.in.draw(rng)));
      if (const auto sample = film.sample(light, rng); sample && way.out.holds(sample->light.frame.k)) {
        const double x = joined(from_film(way.importance, tangential_frame(sample->light.frame.k)), sample->light);
        forward += x;
        forward2 += x * x;
      }
      const StokesVector w = from_film(way.importance, tangential_frame(way.out.draw(rng)));
      if (const auto before = step_back(film, w, BackwardPart::kAll, rng); before && way.in.holds(before->frame.k)) {
        const double x = joined(*before, from_film(way.light, tangential_frame(before->frame.k)));
        backward += x;
        backward2 += x * x;
      }
    }
    const auto estimate = [&](double sum, double squares, double factor) {
      const double mean = sum / draws;
      return core::Estimate{factor * mean, factor * std::sqrt((squares / draws - mean * mean) / draws)};
    };
    const core::Estimate a = estimate(forward, forward2, way.in.projected());
    const core::Estimate b = estimate(backward, backward2, way.out.projected());
    EXPECT_GT(a.value, 10.0 * a.se);
    EXPECT_LT(std::abs(a.value - b.value) / std::hypot(a.se, b.se), z_limit(1e-3, ways.size()))
        << a.value << " " << b.value;
  }
}

const Eigen::Vector4d kNatural(1, 0, 0, 0), kAlong(1, 0.9, 0, 0), kAcross(1, -0.9, 0, 0), kDiagonal(1, 0, 0.9, 0),
    kCircular(1, 0, 0, 0.9), kAny(1, 0.5, -0.4, 0.6);

/// Up through a film, down through it, thrown back from both sides; all kinds of polarization.
std::vector<Way> through(double in_polar, double in_azimuth, double out_polar, double out_azimuth, double half) {
  const Cone in_up{in_polar, in_azimuth, true, half}, out_up{out_polar, out_azimuth, true, half};
  const Cone in_down{in_polar, in_azimuth, false, half}, out_down{out_polar, out_azimuth, false, half};
  return {{in_up, out_up, kNatural, kAny},       {in_up, out_up, kAlong, kAcross},
          {in_up, out_up, kDiagonal, kDiagonal}, {in_up, out_up, kCircular, kDiagonal},
          {in_up, out_up, kDiagonal, kCircular}, {in_up, out_up, kCircular, kCircular},
          {in_down, out_down, kAny, kAny}};
}

BacklightSpec with_film(const std::string& film) {
  return backlight_of("size: {length_mm: 10, width_mm: 10}, sources: [{kind: beam}], films: [" + film + "]");
}

TEST(ReversedBsdf, PrismFilm) {
  const BacklightSpec spec = with_film("{kind: bef, axis_deg: 30, refractive_index: 1.58, absorption_per_m: 200}");
  const Bsdf& film = *spec.films[0].surface;
  expect_same_both_ways(film, through(35, 70, 25, 50, 25), 100'000);
  // Total reflections twice in a prism turn the polarization, and throw light back.
  const Cone up{15, 40, true, 15}, down{15, 40, false, 15};
  expect_same_both_ways(film,
                        {{up, down, kNatural, kNatural},
                         {up, down, kDiagonal, kCircular},
                         {up, down, kCircular, kDiagonal},
                         {up, down, kAlong, kAlong}},
                        100'000);
}

TEST(ReversedBsdf, InvertedPrismFilm) {
  const BacklightSpec spec = with_film("{kind: bef, axis_deg: 100, inverted: true, apex_deg: 68}");
  expect_same_both_ways(*spec.films[0].surface, through(60, 10, 20, 15, 28), 100'000);
}

TEST(ReversedBsdf, TabulatedDbef) {
  const BacklightSpec spec = with_film("{kind: dbef, axis_deg: 20, table: \"" + data_file("dbef.csv") +
                                       "\", hemispherical: \"" + data_file("dbef_hemispherical.csv") + "\"}");
  expect_same_both_ways(*spec.films[0].surface, through(20, 40, 15, 55, 12), 30'000);
  expect_same_both_ways(*spec.films[0].surface, through(60, 40, 66, 20, 12), 30'000);
}

TEST(ReversedBsdf, DiffuserWithStraightLight) {
  const BacklightSpec spec =
      with_film("{kind: diffuser, transmittance: 0.7, reflectance: 0.2, haze: 0.5, fwhm_deg: 30, depolarization: 0.4}");
  expect_same_both_ways(*spec.films[0].surface, through(20, 40, 25, 50, 15), 100'000);
  // Off the lobe, where the even proposals count.
  const std::vector<Way> wide = through(20, 40, 45, 75, 10);
  expect_same_both_ways(*spec.films[0].surface, {wide[0], wide[6]}, 300'000);
}

TEST(ReversedBsdf, SpecularFilms) {
  for (const char* film : {"{kind: dbef, axis_deg: 20, transmittance_pass: 0.8, reflectance_pass: 0.1, "
                           "transmittance_block: 0.1, reflectance_block: 0.7}",
                           "{kind: lpp, axis_deg: 50}", "{kind: retarder, axis_deg: 30, retardance_nm: 150}"}) {
    SCOPED_TRACE(film);
    const BacklightSpec spec = with_film(film);
    expect_same_both_ways(*spec.films[0].surface, {through(30, 40, 30, 40, 12)[1], through(30, 40, 30, 40, 12)[3]},
                          50'000);
  }
}

/// Where nothing shines from above, no draw is wasted on it; what comes back from below is the film's reflection.
TEST(ReversedBsdf, LitFromBelow) {
  const BacklightSpec spec = with_film("{kind: lpp, k1: 0.8, k2: 0.02, reflectance: 0.1}");
  core::PhotonRng rng({1, 0, 0}, 0);
  for (const bool up : {true, false}) {
    const auto w = StokesVector::unpolarized(1.0, core::PolarizationFrame::any(travel(30, 20, up)));
    const auto before = step_back(*spec.films[0].surface, w, BackwardPart::kLitFromBelow, rng);
    ASSERT_TRUE(before);
    EXPECT_GT(before->frame.k.z(), 0.0);
    EXPECT_NEAR(before->I, up ? 0.41 : 0.1, 1e-12);
  }
}

}  // namespace
}  // namespace evenglow::tests

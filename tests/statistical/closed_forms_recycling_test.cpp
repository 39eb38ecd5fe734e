#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// The recycling cavity: a bottom of reflectance eta and a reflective polarizer on top, between ideal mirrors; an even
/// Lambertian source at the bottom. Gain G: what passes the film over what passes an absorbing polarizer in its place.
///
/// The depolarization d per return is here the white share of the light that the bottom returns: a photon comes back
/// either mirrored, in the state that the film has refused (the film reads the same tangential state from a mirrored
/// ray, and walls along the film's axes map its axis on itself, so that the film refuses all of it again), or white,
/// half of it in the pass state. So d = 1 - specular_share exactly, at every angle. Block light B comes back as eta (1
/// - d/2) B of block and eta d/2 B of pass light, from which G = 1 + (eta d/2) / (1 - eta (1 - d/2)).
///
/// Each comparison must lie within 3 standard errors (0.0027 of false alarm each), and all of a test together pass a
/// chi-square test (1e-3). Seeds are fixed.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string cavity(double eta, double specular_share, const std::string& film) {
  return std::string(kMirrorRoom) + ", bottom: {kind: mixed, reflectance: " + text_of(eta) +
         ", specular_share: " + text_of(specular_share) + "}}, films: [" + film +
         "], sources: [{kind: lambertian_face, face: bottom}], receivers: [{kind: flux}]";
}

core::Estimate transmitted(const Traced& traced) {
  EXPECT_EQ(traced.accounted(), traced.photons());
  EXPECT_EQ(traced.lost(), 0.0);
  const double share = traced.escaped(Side::kTop) / traced.photons();
  return {share, std::sqrt(share * (1.0 - share) / traced.photons())};
}

class Comparisons {
 public:
  void add(const core::Estimate& estimate, double expected, const std::string& what) {
    const double z = z_score(estimate, expected);
    EXPECT_LT(std::abs(z), 3.0) << what << ": " << estimate.value << " +- " << estimate.se << " for " << expected;
    sum_ += z * z;
    ++count_;
  }
  ~Comparisons() { EXPECT_GT(chi_square_tail(sum_, count_), 1e-3) << sum_ << " of " << count_; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

const std::string kIdealDbef =
    "{kind: dbef, transmittance_pass: 1, reflectance_pass: 0, transmittance_block: 0, reflectance_block: 1}";
const std::string kIdealAbsorber = "{kind: lpp, k1: 1, k2: 0, reflectance: 0}";

void check_ideal(std::uint64_t photons) {
  Comparisons all;
  std::uint64_t seed = 1;
  for (const double eta : {0.5, 0.62, 0.67, 0.8, 0.9, 0.95, 0.99}) {
    for (const double d : {0.0, 0.3, 0.5, 1.0}) {
      const core::Estimate with = transmitted(Traced(cavity(eta, 1.0 - d, kIdealDbef), {photons, seed++, 10, 1}));
      const core::Estimate without =
          transmitted(Traced(cavity(eta, 1.0 - d, kIdealAbsorber), {photons, seed++, 10, 1}));
      all.add(ratio(with, without), 1.0 + 0.5 * eta * d / (1.0 - eta * (1.0 - 0.5 * d)),
              "eta " + text_of(eta) + " d " + text_of(d));
    }
  }
}

TEST(RecyclingCavity, IdealFilm) {
  check_ideal(20'000);
}
TEST(RecyclingCavityLong, IdealFilm) {
  check_ideal(1'000'000);
}

/// d = 1: G = 1 / (1 - eta / 2); almost 1.5 at an eta of 0.62 to 0.67.
TEST(RecyclingCavity, PaperGainNeedsAnEtaOfTwoThirds) {
  const core::Estimate low = transmitted(Traced(cavity(0.62, 0.0, kIdealDbef), {100'000, 11, 10, 1}));
  const core::Estimate high = transmitted(Traced(cavity(0.67, 0.0, kIdealDbef), {100'000, 12, 10, 1}));
  EXPECT_LT(2.0 * low.value, 1.5);
  EXPECT_GT(2.0 * high.value, 1.49);
}

/// Real films at full depolarization. With T_b = k2 = 0: G = (T_p / k1) (1 - eta R_L) / (1 - eta (R_p + R_b) / 2); with
/// leakage T_p + T_b over k1 + k2 takes the place of T_p over k1, as all that passes is counted.
void check_real(std::uint64_t photons) {
  struct Film {
    double Tp, Rp, Tb, Rb, k1, k2, RL;
  };
  Comparisons all;
  std::uint64_t seed = 1;
  for (const Film& f : {Film{0.887, 0.098, 0.0, 0.932, 0.86, 0.0, 0.04},
                        {0.887, 0.098, 0.053, 0.932, 0.8596, 0.0004, 0.04},
                        {0.7, 0.2, 0.1, 0.5, 0.6, 0.1, 0.3}}) {
    const std::string dbef = "{kind: dbef, axis_deg: 90, transmittance_pass: " + text_of(f.Tp) +
                             ", reflectance_pass: " + text_of(f.Rp) + ", transmittance_block: " + text_of(f.Tb) +
                             ", reflectance_block: " + text_of(f.Rb) + "}";
    const std::string lpp =
        "{kind: lpp, k1: " + text_of(f.k1) + ", k2: " + text_of(f.k2) + ", reflectance: " + text_of(f.RL) + "}";
    for (const double eta : {0.5, 0.65, 0.8, 0.95}) {
      const core::Estimate with = transmitted(Traced(cavity(eta, 0.0, dbef), {photons, seed++, 10, 1}));
      const core::Estimate without = transmitted(Traced(cavity(eta, 0.0, lpp), {photons, seed++, 10, 1}));
      const double G = (f.Tp + f.Tb) / (f.k1 + f.k2) * (1.0 - eta * f.RL) / (1.0 - 0.5 * eta * (f.Rp + f.Rb));
      all.add(ratio(with, without), G, "R_b " + text_of(f.Rb) + " eta " + text_of(eta));
    }
  }
}

TEST(RecyclingCavity, RealFilm) {
  check_real(50'000);
}
TEST(RecyclingCavityLong, RealFilm) {
  check_real(2'000'000);
}

}  // namespace
}  // namespace evenglow::tests

#include "tracer/microstructure/dot_trace.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/bumps.h"
#include "tests/support/chi_square.h"
#include "tests/support/film_bins.h"
#include "tests/support/z_test.h"
#include "tracer/microstructure/dot_shape.h"

/// Light among dots that stand one by one. Seeds are fixed; false alarm 1e-3 for each test, over all its comparisons.
namespace evenglow::tests {
namespace {

using core::Footprint;
using core::StokesVector;
using core::Vec2;
using core::Vec3;
using tracer::DotGrid;
using tracer::DotShape;

constexpr double kIndex = 1.4938;
constexpr int kCells = 200;  ///< of the lattice, along each side

/// Dots of radius 10 um in a square lattice whose cells they fill to the share `fill`.
DotGrid lattice_of(double fill, Footprint footprint) {
  const double area = core::footprint_area(footprint, 0.02);
  const double pitch = std::sqrt(area / fill);
  core::DotPattern dots;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) dots.push_back({(i + 0.5) * pitch, (j + 0.5) * pitch, 0.01F});
  }
  return {dots, footprint, {0.0, kCells * pitch, 0.0, kCells * pitch}};
}

/// A place in the middle cells.
Vec2 place_in(const DotGrid& dots, core::PhotonRng& rng) {
  const double pitch = dots.face().x1 / kCells;
  const double x = rng.uniform();
  return {pitch * (kCells / 2 + x), pitch * (kCells / 2 + rng.uniform())};
}

std::size_t bin_of(const Vec3& k) {
  const double sin2 = k.x() * k.x() + k.y() * k.y();
  const int polar = std::min(static_cast<int>(sin2 * 8), 7);
  const double turns = std::atan2(k.y(), k.x()) / (2.0 * core::kPi) + 1.0;
  const int azimuth = static_cast<int>((turns - std::floor(turns)) * 8) % 8;
  return static_cast<std::size_t>(((k.z() > 0.0 ? 1 : 0) * 8 + polar) * 8 + azimuth);
}

/// Where light goes, and with what mean polarization (film's count).
struct Outcomes {
  std::array<double, 128> counts{};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();

  void add(const StokesVector& light) {
    counts[bin_of(light.frame.k)] += 1.0;
    const Eigen::Vector3d s = tracer::to_film(light, tracer::tangential_frame(light.frame.k)).tail<3>();
    sum += s;
    squares += s.cwiseAbs2();
  }
};

/// The periodic patch of `TracedBump` is exact. Dots in the same lattice, one by one, must do the same to light: the
/// two are code of their own from the search for the next facet to the way beside the bumps.
void compare_with_patch(const std::string& keys, double fill, Footprint footprint, const Vec3& k, double comparisons,
                        std::uint32_t stream) {
  constexpr int kPhotons = 40'000;
  const auto patch = optics_of(keys + ", face: top, fill: " + std::to_string(fill), kIndex);
  const auto* shape = dynamic_cast<const DotShape*>(patch.get());
  ASSERT_NE(shape, nullptr);
  const DotGrid dots = lattice_of(fill, footprint);
  const StokesVector light{1.0, 0.3, -0.5, 0.2, tracer::tangential_frame(k).frame};
  Outcomes expected, found;
  int absorbed = 0;
  for (std::uint64_t i = 0; i < kPhotons; ++i) {
    core::PhotonRng rng({11, stream, 0}, i), other({11, stream, 1}, i);
    if (const auto sample = patch->sample(light, rng)) expected.add(sample->light);
    const auto outcome = shape->sample_among(dots, place_in(dots, other), light, other);
    outcome ? found.add(outcome->light) : void(++absorbed);
  }
  EXPECT_LT(absorbed, 5) << keys;
  double chi2 = 0.0;
  int degrees = -1;
  for (std::size_t bin = 0; bin < expected.counts.size(); ++bin) {
    const double both = expected.counts[bin] + found.counts[bin];
    if (both < 20.0) continue;
    chi2 += std::pow(expected.counts[bin] - found.counts[bin], 2) / both;
    ++degrees;
  }
  EXPECT_GT(chi_square_tail(chi2, degrees), sidak(5e-4, static_cast<std::size_t>(comparisons)))
      << keys << ": chi-square " << chi2 << " of " << degrees;
  for (int i = 0; i < 3; ++i) {
    const double d = (expected.sum[i] - found.sum[i]) / kPhotons;
    const double se = std::sqrt((expected.squares[i] + found.squares[i])) / kPhotons;
    EXPECT_LT(std::abs(d / se), z_limit(5e-4, static_cast<std::size_t>(3.0 * comparisons))) << keys << ", " << i;
  }
}

TEST(DotTrace, ALatticeDoesWhatThePeriodicPatchDoes) {
  struct Case {
    const char* keys;
    double fill;
    Footprint footprint;
  };
  const std::vector<Case> cases = {
      {"kind: microlens, aspect: 0.4", 0.3, Footprint::round},
      {"kind: microlens, aspect: 0.3, form: sunk", 0.6, Footprint::round},
      {"kind: cone, flank_deg: 60", 0.5, Footprint::round},
      {"kind: cone, flank_deg: 45, truncation: 0.5, form: sunk", 0.4, Footprint::round},
      {"kind: pyramid, flank_deg: 50", 0.3, Footprint::square},
      {"kind: pyramid, flank_deg: 70, truncation: 0.3, form: sunk", 0.2, Footprint::square},
  };
  const std::vector<Vec3> directions = {travel(20, 10, true), travel(61, 130, true), travel(80, 200, true),
                                        travel(29, 50), travel(75, 100)};
  std::uint32_t stream = 0;
  for (const Case& c : cases) {
    for (const Vec3& k : directions)
      compare_with_patch(c.keys, c.fill, c.footprint, k, static_cast<double>(cases.size() * directions.size()),
                         ++stream);
  }
}

/// On the bottom face the same dots do to light what they do on the top face to light turned by half about x.
TEST(DotTrace, TheBottomFaceIsTheTopFaceTurned) {
  const auto turned = [](const Vec3& v) { return Vec3(v.x(), -v.y(), -v.z()); };
  core::DotPattern dots{{1.0, 1.0, 0.3F}, {1.7, 1.3, 0.25F}}, mirrored = dots;
  for (core::Dot& dot : mirrored) dot.y = 3.0 - dot.y;
  const tracer::FaceArea face{0.0, 3.0, 0.0, 3.0};
  const DotGrid on_top(dots, Footprint::round, face), below(mirrored, Footprint::round, face);
  for (const std::string keys : {"kind: cone, flank_deg: 40", "kind: microlens, aspect: 0.3, form: sunk"}) {
    const auto top = optics_of(keys + ", face: top", kIndex), bottom = optics_of(keys + ", face: bottom", kIndex);
    const auto& a = dynamic_cast<const DotShape&>(*top);
    const auto& b = dynamic_cast<const DotShape&>(*bottom);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      core::PhotonRng rng({5, 6, 7}, i);
      const Vec2 place(0.5 + 1.7 * rng.uniform(), 0.5 + 1.3 * rng.uniform());
      const Vec3 k = travel(89.0 * rng.uniform(), 360.0 * rng.uniform(), i % 2 == 0);
      const StokesVector light{1.0, 0.4, 0.1, -0.3, core::PolarizationFrame::any(k)};
      const StokesVector same{1.0, 0.4, 0.1, -0.3, {turned(k), turned(light.frame.e1)}};
      const Vec2 other(place.x(), 3.0 - place.y());
      ASSERT_EQ(a.meets_dot(on_top, place, k), b.meets_dot(below, other, turned(k))) << i;
      core::PhotonRng one({5, 6, 8}, i), two({5, 6, 8}, i);
      const auto x = a.sample_among(on_top, place, light, one), y = b.sample_among(below, other, same, two);
      ASSERT_EQ(x.has_value(), y.has_value());
      if (!x) continue;
      EXPECT_LT((x->light.frame.k - turned(y->light.frame.k)).norm(), 1e-9);
      EXPECT_LT(std::abs(x->place.x() - y->place.x()) + std::abs(x->place.y() + y->place.y() - 3.0), 1e-6);
      EXPECT_NEAR(x->light.V, y->light.V, 1e-9);
    }
  }
}

/// Where `meets_dot` says no, the smooth face is all there is: light leaves by Fresnel, where it came.
TEST(DotTrace, WhereNoDotIsMetTheFaceIsSmooth) {
  const DotGrid dots = lattice_of(0.15, Footprint::round);
  const auto optics = optics_of("kind: microlens, aspect: 0.4, face: top", kIndex);
  const auto& shape = dynamic_cast<const DotShape&>(*optics);
  int smooth = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    core::PhotonRng rng({1, 2, 3}, i);
    const Vec2 place = place_in(dots, rng);
    const Vec3 k = travel(85.0 * rng.uniform(), 360.0 * rng.uniform(), i % 2 == 0);
    if (shape.meets_dot(dots, place, k)) continue;
    ++smooth;
    const auto outcome =
        shape.sample_among(dots, place, StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng);
    ASSERT_TRUE(outcome);
    const Vec3& out = outcome->light.frame.k;
    EXPECT_LT((outcome->place - place).norm(), 1e-9);
    const double ratio = out.z() * k.z() < 0.0 ? 1.0 : k.z() > 0.0 ? kIndex : 1.0 / kIndex;
    EXPECT_LT((out.head<2>() - ratio * k.head<2>()).norm(), 1e-9);
  }
  EXPECT_GT(smooth, 8000);
}

/// Each dot is as high as its size says: a ray just above the top of a small one beside a large one passes it.
TEST(DotTrace, HeightsFollowSizes) {
  const tracer::FaceArea face{0.0, 10.0, 0.0, 10.0};
  const DotGrid dots({{3.0, 5.0, 0.1F}, {7.0, 5.0, 1.0F}}, Footprint::round, face);
  const auto optics = optics_of("kind: cone, aspect: 0.5, truncation: 0.9, face: top", kIndex);
  const auto& shape = dynamic_cast<const DotShape&>(*optics);
  // Height = diameter / 2: 0.1 and 1 mm. Light from above at 45 degrees along +x that would come to the face at x.
  const Vec3 k = Vec3(1.0, 0.0, -1.0).normalized();
  EXPECT_TRUE(shape.meets_dot(dots, {3.15, 5.0}, k));
  EXPECT_FALSE(shape.meets_dot(dots, {3.25, 5.0}, k));
  EXPECT_TRUE(shape.meets_dot(dots, {8.8, 5.0}, k));
  EXPECT_FALSE(shape.meets_dot(dots, {8.8, 6.2}, k));
}

}  // namespace
}  // namespace evenglow::tests

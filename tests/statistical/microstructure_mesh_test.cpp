#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/bump_mesh.h"
#include "tests/support/bumps.h"
#include "tests/support/film_bins.h"

/// Each clear shape against an explicit mesh of its pattern in Embree, traced with field vectors: counts by outgoing
/// direction and the polarization there. Seeds are fixed. Chi-square per degree of freedom has the mean 1 and the
/// standard deviation sqrt(2 / degrees).
namespace evenglow::tests {
namespace {

using core::StokesVector;
using core::Vec3;
constexpr double kIndex = 1.4938;
constexpr double kRad = core::kRadPerDeg;

/// Outgoing directions: side, sin^2 of the polar angle, azimuth (from an odd angle, as flat facets send light into
/// symmetry planes). Counts, and sums of Q, U, V with their squares.
class DirectionBins {
 public:
  static constexpr int kPolar = 16, kAzimuth = 32;
  static constexpr std::size_t kCount = 2 * kPolar * kAzimuth;

  void add(const Vec3& k, const StokesVector& light) {
    const double sin2 = k.x() * k.x() + k.y() * k.y();
    const int polar = std::min(static_cast<int>(sin2 * kPolar), kPolar - 1);
    const double turns = std::atan2(k.y(), k.x()) / (2.0 * core::kPi) + 1.0 + 0.0123;
    const int azimuth = static_cast<int>((turns - std::floor(turns)) * kAzimuth) % kAzimuth;
    Cell& cell = cells_[static_cast<std::size_t>(((k.z() > 0.0 ? 1 : 0) * kPolar + polar) * kAzimuth + azimuth)];
    const Eigen::Vector3d s(light.Q, light.U, light.V);
    cell.count += 1.0;
    cell.sum += s;
    cell.squares += s.cwiseProduct(s);
  }

  struct Cell {
    double count = 0.0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  };
  const std::array<Cell, kCount>& cells() const { return cells_; }

 private:
  std::array<Cell, kCount> cells_{};
};

struct ChiSquare {
  double sum = 0.0;
  double degrees = 0.0;

  void add(double z2) {
    sum += z2;
    degrees += 1.0;
  }
  double per_degree() const { return sum / degrees; }
};

/// Two histories of the same light; equal numbers of photons.
void compare(const DirectionBins& a, const DirectionBins& b, ChiSquare& counts, ChiSquare& states) {
  for (std::size_t i = 0; i < DirectionBins::kCount; ++i) {
    const auto& x = a.cells()[i];
    const auto& y = b.cells()[i];
    if (x.count + y.count < 20.0) continue;
    counts.add((x.count - y.count) * (x.count - y.count) / (x.count + y.count));
    if (x.count < 100.0 || y.count < 100.0) continue;
    for (int j = 0; j < 3; ++j) {
      const double mx = x.sum[j] / x.count, my = y.sum[j] / y.count;
      const double vx = x.squares[j] / x.count - mx * mx, vy = y.squares[j] / y.count - my * my;
      // Below 1e-4 the states are one state and rounding (single precision finds the mesh).
      const double variance = std::max(0.0, vx) / x.count + std::max(0.0, vy) / y.count;
      if (variance < 1e-10) {
        EXPECT_NEAR(mx, my, 1e-3);
        continue;
      }
      states.add((mx - my) * (mx - my) / variance);
    }
  }
  counts.degrees -= 1.0;  // the totals are equal
}

struct Case {
  std::string keys;
  BumpPattern pattern;
};

BumpPattern cap(bool sunk, double aspect) {
  BumpPattern p;
  p.shape = BumpPattern::Shape::kCap;
  p.sunk = sunk;
  p.aspect = aspect;
  return p;
}

BumpPattern tapered(BumpPattern::Shape shape, bool sunk, double flank_deg, double truncation = 0.0) {
  BumpPattern p;
  p.shape = shape;
  p.sunk = sunk;
  p.flank = flank_deg * kRad;
  p.truncation = truncation;
  return p;
}

/// On the bottom face the surface's y runs against the plate's: axis a has its bump's x at 90 degrees - a.
BumpPattern turned(BumpPattern p, double axis_deg, bool top) {
  p.turn = (top ? axis_deg - 90.0 : 90.0 - axis_deg) * kRad;
  return p;
}

BumpPattern groove(bool sunk, double left_deg, double right_deg, double axis_deg, bool top) {
  BumpPattern p = tapered(BumpPattern::Shape::kGroove, sunk, left_deg);
  p.right = right_deg * kRad;
  return turned(p, axis_deg, top);
}

/// In a cell that the footprint fills by this share.
BumpPattern spaced(BumpPattern p, double fill) {
  p.cell = std::sqrt((p.shape == BumpPattern::Shape::kPyramid ? 1.0 : 0.25 * core::kPi) / fill);
  if (p.shape == BumpPattern::Shape::kGroove) p.cell = 1.0 / fill;
  return p;
}

std::vector<Case> cases() {
  using Shape = BumpPattern::Shape;
  return {
      {"kind: microlens, aspect: 0.2", cap(false, 0.2)},
      {"kind: microlens, aspect: 0.5", cap(false, 0.5)},
      {"kind: microlens, aspect: 0.15, form: sunk", cap(true, 0.15)},
      {"kind: cone, flank_deg: 50", tapered(Shape::kCone, false, 50)},
      {"kind: cone, flank_deg: 40, truncation: 0.4", tapered(Shape::kCone, false, 40, 0.4)},
      {"kind: cone, flank_deg: 35, form: sunk", tapered(Shape::kCone, true, 35)},
      {"kind: cone, flank_deg: 65, truncation: 0.2, form: sunk", tapered(Shape::kCone, true, 65, 0.2)},
      {"kind: pyramid, flank_deg: 50, axis_deg: 25", turned(tapered(Shape::kPyramid, false, 50), 25, false)},
      {"kind: pyramid, flank_deg: 30, truncation: 0.3, form: sunk, axis_deg: 70, face: top",
       turned(tapered(Shape::kPyramid, true, 30, 0.3), 70, true)},
      {"kind: v_groove, flanks_deg: [40, 70], axis_deg: 60", groove(false, 40, 70, 60, false)},
      {"kind: v_groove, flanks_deg: [55, 25], form: sunk, axis_deg: 130, face: top", groove(true, 55, 25, 130, true)},
      {"kind: microlens, aspect: 0.4, fill: 0.3", turned(spaced(cap(false, 0.4), 0.3), 0, false)},
      {"kind: microlens, aspect: 0.5, form: sunk, fill: 0.7", turned(spaced(cap(true, 0.5), 0.7), 0, false)},
      {"kind: cone, form: sunk, fill: 0.15", turned(spaced(tapered(Shape::kCone, true, 45), 0.15), 0, false)},
      {"kind: pyramid, flank_deg: 60, axis_deg: 40, form: sunk, fill: 0.4",
       turned(spaced(tapered(Shape::kPyramid, true, 60), 0.4), 40, false)},
      {"kind: v_groove, flanks_deg: [35, 50], axis_deg: 20, fill: 0.3, face: top",
       spaced(groove(false, 35, 50, 20, true), 0.3)},
  };
}

/// Natural, linear and circular light in turn.
StokesVector light_number(int i, const Vec3& k) {
  const core::PolarizationFrame frame = tracer::tangential_frame(k).frame;
  if (i % 4 == 0) return StokesVector::unpolarized(1.0, frame);
  if (i % 4 == 3) return {1.0, 0.0, 0.0, i % 8 == 3 ? 1.0 : -1.0, frame};
  return StokesVector::linear(1.0, (30.0 + 47.0 * i) * kRad, frame);
}

struct Verdict {
  ChiSquare counts, states;
  double slipped = 0.0;
};

/// `incidences` from inside and from outside, all polar angles, all kinds of light.
Verdict judge(const Case& shape, int incidences, int photons) {
  Verdict verdict;
  const auto optics = optics_of(shape.keys, kIndex);
  BumpPattern pattern = shape.pattern;
  pattern.index = kIndex;
  const BumpMesh mesh(pattern);
  for (int i = 0; i < incidences; ++i) {
    // All angles from 2 to 83 degrees, each side; azimuths by the golden angle.
    const double polar = 2.0 + 81.0 * ((i / 2) + 0.5) / (0.5 * incidences);
    const Vec3 k = travel(polar, 11.0 + 137.508 * i, i % 2 == 0);
    const StokesVector light = light_number(i, k);
    DirectionBins traced, meshed;
    core::PhotonRng rng({20261122, static_cast<std::uint32_t>(i), 0}, 0);
    core::PhotonRng mesh_rng({20261122, static_cast<std::uint32_t>(i), 1}, 0);
    for (int photon = 0; photon < photons; ++photon) {
      const auto out = optics->sample(light, rng);
      EXPECT_TRUE(out && out->specular);
      if (!out) continue;
      const Vec3& k_out = out->light.frame.k;
      traced.add(k_out, out->light.in_frame(tracer::tangential_frame(k_out).frame.e1));
      auto reference = mesh.trace(field_of(light, mesh_rng), mesh_rng);
      while (!reference) {
        verdict.slipped += 1.0;
        reference = mesh.trace(field_of(light, mesh_rng), mesh_rng);
      }
      meshed.add(reference->k, stokes_of(*reference));
    }
    compare(traced, meshed, verdict.counts, verdict.states);
  }
  verdict.slipped /= static_cast<double>(incidences) * photons;
  return verdict;
}

void expect_agreement(int incidences, int photons, double all_within, double shape_within) {
  ChiSquare all;
  for (const Case& shape : cases()) {
    const Verdict v = judge(shape, incidences, photons);
    EXPECT_LT(v.slipped, 2e-3) << shape.keys;
    EXPECT_NEAR(v.counts.per_degree(), 1.0, shape_within * std::sqrt(2.0 / v.counts.degrees)) << shape.keys;
    EXPECT_NEAR(v.states.per_degree(), 1.0, shape_within * std::sqrt(2.0 / v.states.degrees)) << shape.keys;
    all.sum += v.counts.sum + v.states.sum;
    all.degrees += v.counts.degrees + v.states.degrees;
  }
  EXPECT_NEAR(all.per_degree(), 1.0, all_within);
}

/// About 1e6 photons in all; 4.5 standard deviations a shape (false alarm 1.5e-4 in all).
TEST(MicrostructureMesh, EachShapeAsItsMesh) {
  expect_agreement(16, 6000, 0.08, 4.5);
}

TEST(MicrostructureMeshLong, EachShapeAsItsMesh) {
  expect_agreement(40, 50'000, 0.03, 4.5);
}

}  // namespace
}  // namespace evenglow::tests

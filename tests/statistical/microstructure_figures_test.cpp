#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/bumps.h"
#include "tests/support/z_test.h"

/// The table of docs/microstructures.md: what one meeting of guided light with each shape sends out of the plate.
namespace evenglow::tests {
namespace {

using core::Vec3;
constexpr double kIndex = 1.4938;

/// Natural light through the edge at x = 0, Lambertian in air, as it meets the patterned face: of constant radiance
/// within asin(1/n) of +x, by the cosine to the face.
Vec3 guided(core::PhotonRng& rng) {
  const double sine = 1.0 / kIndex;
  const double least = std::sqrt(1.0 - sine * sine);
  for (;;) {
    const double x = least + (1.0 - least) * rng.uniform();
    const double across = std::sqrt(1.0 - x * x);
    const double azimuth = 2.0 * core::kPi * rng.uniform();
    const Vec3 k(x, across * std::cos(azimuth), std::abs(across * std::sin(azimuth)));
    if (rng.uniform() * sine < k.z()) return k;
  }
}

struct Row {
  std::string keys;
  /// Share of a meeting, over fill: out through the patterned face, and back into the cone that leaves by the other.
  std::array<double, 2> filled, third;  ///< with fill 1, 0.3
};

const Row kRows[] = {
    {"kind: microlens, aspect: 0.05", {0.003, 0.055}, {0.004, 0.054}},
    {"kind: microlens, aspect: 0.1", {0.035, 0.186}, {0.044, 0.190}},
    {"kind: microlens, aspect: 0.2", {0.133, 0.285}, {0.194, 0.319}},
    {"kind: microlens, aspect: 0.5", {0.296, 0.027}, {0.625, 0.080}},
    {"kind: cone, flank_deg: 20", {0.063, 0.282}, {0.078, 0.287}},
    {"kind: cone, flank_deg: 45", {0.247, 0.173}, {0.380, 0.200}},
    {"kind: cone, flank_deg: 45, truncation: 0.5", {0.216, 0.164}, {0.335, 0.203}},
    {"kind: pyramid, flank_deg: 20", {0.072, 0.268}, {0.089, 0.276}},
    {"kind: pyramid, flank_deg: 45", {0.241, 0.336}, {0.391, 0.367}},
    {"kind: v_groove, flanks_deg: [20, 20]", {0.141, 0.538}, {0.177, 0.556}},
    {"kind: v_groove, flanks_deg: [45, 45]", {0.326, 0.343}, {0.614, 0.308}},
    {"kind: microlens, form: sunk, aspect: 0.05", {0.004, 0.055}, {0.004, 0.055}},
    {"kind: microlens, form: sunk, aspect: 0.1", {0.042, 0.186}, {0.042, 0.188}},
    {"kind: microlens, form: sunk, aspect: 0.2", {0.146, 0.215}, {0.165, 0.372}},
    {"kind: microlens, form: sunk, aspect: 0.5", {0.143, 0.189}, {0.459, 0.485}},
    {"kind: cone, form: sunk, flank_deg: 20", {0.068, 0.280}, {0.067, 0.282}},
    {"kind: cone, form: sunk, flank_deg: 45", {0.202, 0.140}, {0.304, 0.418}},
    {"kind: cone, form: sunk, flank_deg: 45, truncation: 0.5", {0.188, 0.103}, {0.271, 0.380}},
    {"kind: pyramid, form: sunk, flank_deg: 20", {0.079, 0.268}, {0.079, 0.270}},
    {"kind: pyramid, form: sunk, flank_deg: 45", {0.221, 0.205}, {0.334, 0.492}},
    {"kind: v_groove, form: sunk, flanks_deg: [20, 20]", {0.141, 0.538}, {0.142, 0.540}},
    {"kind: v_groove, form: sunk, flanks_deg: [45, 45]", {0.326, 0.345}, {0.546, 0.850}},
};

/// Seeds are fixed; false alarm 1e-3 in all. The table's own error is about 0.001.
TEST(MicrostructureFigures, TableOfExtraction) {
  const double limit = z_limit(1e-3, 4 * std::size(kRows));
  std::uint32_t stream = 0;
  for (const Row& row : kRows) {
    for (const double fill : {1.0, 0.3}) {
      const auto optics = optics_of(row.keys + (fill < 1.0 ? ", fill: 0.3" : ""), kIndex);
      const int photons = static_cast<int>(20'000 / fill);
      core::PhotonRng rng({20261122, ++stream, 0}, 0);
      int out = 0, back = 0;
      for (int i = 0; i < photons; ++i) {
        const Vec3 k = guided(rng);
        const auto left = optics->sample(core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), rng);
        const Vec3& k_out = left->light.frame.k;
        if (k_out.z() > 0.0) ++out;
        if (k_out.z() < 0.0 && std::hypot(k_out.x(), k_out.y()) < 1.0 / kIndex) ++back;
      }
      const auto& expected = fill < 1.0 ? row.third : row.filled;
      const auto near = [&](int count, double share) {
        const double p = count / static_cast<double>(photons);
        EXPECT_LT(std::abs(p / fill - share), 0.002 + limit * std::sqrt(p * (1.0 - p) / photons) / fill)
            << row.keys << " fill " << fill;
      };
      near(out, expected[0]);
      near(back, expected[1]);
    }
  }
}

}  // namespace
}  // namespace evenglow::tests

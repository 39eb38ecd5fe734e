#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"
#include "tracer/transport/photon_history.h"

/// Light of several wavelengths. Seeds fixed; limits are 4.5 standard errors: false alarm 7e-6 a comparison.
namespace evenglow::tests {
namespace {

using tracer::Side;

const std::string kRoom =
    "size: {length_mm: 40, width_mm: 20}, films: [{kind: diffuser, transmittance: 0.6, reflectance: 0.3}], "
    "reflectors: {bottom: {kind: white, reflectance: 0.9, gap_mm: 1}}, ";

std::string lit_by(const std::string& spectrum) {
  return kRoom + "sources: [{kind: lambertian_face, face: bottom, flux_lm: 50, spectrum: " + spectrum +
         "}], receivers: [{kind: luminance, cells: [4, 2], cone_deg: 20}, {kind: color}]";
}

TEST(Spectral, OneLineOf550IsTheRunWithoutASpectrum) {
  const std::string source = "sources: [{kind: lambertian_face, face: bottom, flux_lm: 50";
  const Traced plain(kRoom + source + "}]", {});
  const Traced line(kRoom + source + ", spectrum: {kind: monochromatic, wavelength_nm: 550}}]", {});
  for (std::size_t bin = 0; bin < plain.result().luminance.bins(); ++bin) {
    ASSERT_EQ(plain.result().luminance.total(bin).value, line.result().luminance.total(bin).value);
  }
}

TEST(Spectral, AGrayBacklightKeepsTheColorOfItsLight) {
  // Nothing here depends on the wavelength: X : Y : Z on the display are those of the source.
  const Traced white(lit_by("{kind: white_led}"), {200'000});
  ASSERT_GT(white.scene().bands.size(), 12U);
  const core::Vec3 emitted = white.scene().bands.mean_weight();
  const auto& result = white.result();
  for (std::size_t bin = 0; bin < result.luminance.bins(); ++bin) {
    // Ratio of sums over batches: error of X - x Y with x the expected ratio.
    const auto distance = [&](const core::Tally& other, double ratio) {
      std::vector<double> rest;
      for (std::size_t b = 0; b < other.batches(); ++b) {
        rest.push_back(other.batch(b)[bin] - ratio * result.luminance.batch(b)[bin]);
      }
      const core::Estimate sum = core::total_of_batches(rest);
      return sum.value / sum.se;
    };
    EXPECT_LT(std::abs(distance(result.color_x, emitted.x())), 4.5) << bin;
    EXPECT_LT(std::abs(distance(result.color_z, emitted.z())), 4.5) << bin;
  }
}

TEST(Spectral, SharesOfTheFluxSumToOne) {
  // Photons carry different luminous flux where color is asked for; the account still closes, on average.
  const Traced white(lit_by("{kind: rgb}"), {200'000});
  double sum = 0.0, variance = 0.0;
  for (std::size_t bin = 0; bin < white.result().energy.bins(); ++bin) {
    sum += white.result().energy.total(bin).value;
    variance += std::pow(white.result().energy.total(bin).se, 2);
  }
  EXPECT_NEAR(sum / white.photons(), 1.0, 4.5 * std::sqrt(variance) / white.photons());
  // By luminance alone every photon counts alike.
  const Traced even(kRoom + "sources: [{kind: lambertian_face, face: bottom, flux_lm: 50, spectrum: {kind: rgb}}]", {});
  EXPECT_NEAR(even.accounted(), even.photons(), 1e-6);
}

/// Share of the photons that would leave a lossless plate by its far end, each weighed with what `loss` (1/mm) leaves
/// of it on its own way through the plate; and the mean way.
struct Passage {
  double share = 0.0, se = 0.0, mean_way = 0.0;
};

Passage passage(const std::string& plate, double loss, std::uint64_t photons) {
  const tracer::Scene scene = scene_of("light_guide_plate: {length_mm: 300, width_mm: 30, thickness_mm: 3, " + plate +
                                       "}, sources: [{kind: lambertian_face, face: left}], reflectors: {left: {kind: "
                                       "mirror, reflectance: 0, gap_mm: 1}}");
  const tracer::DensityField density = tracer::initial_density(scene.spec);
  const tracer::PhotonHistory history(scene, density);
  Passage p;
  double squares = 0.0, arrived = 0.0;
  for (std::uint64_t i = 0; i < photons; ++i) {
    core::PhotonRng rng({77, 0, 0}, i);
    tracer::BatchSums sums(scene);
    auto walk = history.start(rng);
    double way = 0.0;
    core::Vec3 from = walk.photon.position;
    bool inside = false;
    for (int events = 0; events < 100000 && history.step(walk, rng, sums); ++events) {
      if (inside) way += (walk.photon.position - from).norm();
      from = walk.photon.position;
      inside = walk.photon.body >= 0;
    }
    if (sums.energy[static_cast<std::size_t>(Side::kRight)] == 0.0) continue;
    const double left = std::exp(-loss * way);
    p.share += left;
    squares += left * left;
    p.mean_way += way;
    arrived += 1.0;
  }
  p.mean_way /= arrived;
  const auto n = static_cast<double>(photons);
  p.share /= n;
  p.se = std::sqrt((squares / n - p.share * p.share) / n);
  return p;
}

TEST(Spectral, FarEndOfALongPlateByBeerAndLambert) {
  // 300 mm PMMA that absorbs 2 per meter at 450 nm and 0.5 at 630 nm, dispersion included. The lossless plate gives the
  // way of each photon; what absorption leaves of it is Beer-Lambert's. The traced plate loses photons on their way.
  const TempFolder folder;
  std::ofstream(folder.path() / "loss.csv") << "# nm, 1/m\nwavelength_nm,absorption_per_m\n450,2\n630,0.5\n";
  constexpr std::uint64_t kPhotons = 40'000;
  for (const auto& [nm, per_m] : {std::pair{450.0, 2.0}, std::pair{630.0, 0.5}}) {
    const std::string plate = "length_mm: 300, width_mm: 30, thickness_mm: 3, material: pmma, absorption_file: '" +
                              (folder.path() / "loss.csv").string() + "'";
    const Traced traced("light_guide_plate: {" + plate +
                            "}, sources: [{kind: lambertian_face, face: left, spectrum: "
                            "{kind: monochromatic, wavelength_nm: " +
                            text_of(nm) + "}}], reflectors: {left: {kind: mirror, reflectance: 0, gap_mm: 1}}",
                        {kPhotons});
    const tracer::Material pmma = tracer::material("pmma", nm);
    const Passage expected = passage("refractive_index: " + text_of(pmma.refractive_index), per_m / 1000.0, kPhotons);
    const double share = traced.escaped(Side::kRight) / traced.photons();
    const double se = std::hypot(expected.se, std::sqrt(share * (1.0 - share) / traced.photons()));
    EXPECT_NEAR(share, expected.share, 4.5 * se) << nm;
    EXPECT_GT(expected.mean_way, 310.0);
    std::printf("%g nm: share at the far end %.4f, by the ways %.4f +- %.4f, mean way %.0f mm\n", nm, share,
                expected.share, expected.se, expected.mean_way);
  }
}

}  // namespace
}  // namespace evenglow::tests

#include "tracer/goniometer/goniometer_trace.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kRad = core::kRadPerDeg;

GoniometerSpec spec_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("goniometer: " + yaml, "run.yaml");
  return read_goniometer(document.root().map("goniometer", ""));
}

TEST(GoniometerTrace, OneTraceServesBothKindsUnlessTheirFilterDiffers) {
  const char* const film = "{film: {kind: diffuser}, psi_deg: [0, 90], filter: {angles_deg: [0, 45, 90]";
  const auto shared = settings_of(spec_of(std::string(film) + "}}"));
  EXPECT_EQ(shared.size(), 2u * 4u);  // natural and three angles
  for (const TracedSetting& setting : shared) EXPECT_EQ(setting.kinds.size(), 2u);
  const auto apart = settings_of(spec_of(std::string(film) + ", offset_reflection_deg: 3}}"));
  EXPECT_EQ(apart.size(), 2u * (1u + 2u * 3u));
}

TEST(GoniometerTrace, ALambertianFilmFillsTheConeByItsSolidAngle) {
  // Hits: T / pi times the integral of the cosine over the cone, pi sin^2 a cos theta. Seed fixed; 4.5 standard errors.
  const GoniometerSpec spec = spec_of(
      "{film: {kind: diffuser, lobe: lambertian, transmittance: 0.7, reflectance: 0.2}, psi_deg: [0], filter: "
      "{angles_deg: []}, detector: {theta_deg: [0, 40], acceptance_deg: 5}}");
  auto settings = settings_of(spec);
  ASSERT_FALSE(settings.empty());
  ASSERT_TRUE(trace_settings(spec, {.photons = 200'000, .batches = 20, .seed = 5}, settings));
  const double cone = std::pow(std::sin(5.0 * kRad), 2);
  for (std::size_t k = 0; k < settings[0].kinds.size(); ++k) {
    const double share = settings[0].kinds[k] == ScatterKind::transmission ? 0.7 : 0.2;
    for (std::size_t t = 0; t < 2; ++t) {
      const double p = share * cone * std::cos(spec.theta[t]);
      EXPECT_NEAR(settings[0].hits[2 * k + t].hits, 200'000 * p, 4.5 * std::sqrt(200'000 * p));
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer

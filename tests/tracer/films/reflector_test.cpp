#include "tracer/films/reflector.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/config_node.h"
#include "core/light/mueller.h"

namespace evenglow::tracer {
namespace {

struct Shares {
  double gap, all, mirrored;
};

Shares shares_of(const std::string& keys) {
  const core::ConfigDocument document = core::ConfigDocument::parse("bottom: {" + keys + "}", "test.yaml");
  const Reflector reflector = make_reflector(document.root().map("bottom", "sheet"));
  document.finish();
  const core::Vec3 down(0.0, 0.0, -1.0);
  const double mirrored = reflector.surface->specular(down).reflection(0, 0);
  const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(down));
  return {reflector.gap, mirrored + core::kPi * reflector.surface->evaluate(light, -down).I, mirrored};
}

TEST(Reflector, DefaultsOfEachKind) {
  const Shares white = shares_of("kind: white");
  EXPECT_NEAR(white.all, 0.96, 1e-12);
  EXPECT_EQ(white.mirrored, 0.0);
  EXPECT_EQ(white.gap, 0.05);
  EXPECT_NEAR(shares_of("reflectance: 0.5").all, 0.5, 1e-12);  // white by default
  const Shares mirror = shares_of("kind: mirror");
  EXPECT_NEAR(mirror.mirrored, 0.98, 1e-12);
  EXPECT_NEAR(mirror.all, 0.98, 1e-12);
  const Shares mixed = shares_of("kind: mixed, reflectance: 0.9, specular_share: 0.25, gap_mm: 0.2");
  EXPECT_NEAR(mixed.mirrored, 0.225, 1e-12);
  EXPECT_NEAR(mixed.all, 0.9, 1e-12);
  EXPECT_EQ(mixed.gap, 0.2);
}

TEST(Reflector, RefusesWhatIsNone) {
  EXPECT_THROW(shares_of("kind: black"), core::ConfigError);
  EXPECT_THROW(shares_of("reflectance: 1.01"), core::ConfigError);
  EXPECT_THROW(shares_of("gap_mm: 0"), core::ConfigError);
  EXPECT_THROW(shares_of("kind: white, specular_share: 0.5"), core::ConfigError);  // of no meaning there
}

}  // namespace
}  // namespace evenglow::tracer

#include "tracer/sources/ray_sampler.h"

#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/chi_square.h"
#include "tests/support/ray_files.h"
#include "tests/support/temp_folder.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::Vec3;
using ::testing::HasSubstr;

class RaySamplerTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& bytes) {
    write_text(folder_ / "rays", bytes);
    return folder_ / "rays";
  }

  RaySampler sampler(const std::string& bytes, RayFileAxis axis = RayFileAxis::kPlusZ) {
    const auto file = write(bytes);
    const RayFileLayout layout = read_ray_file_head(file, "auto");
    flux_ = scan_rays(file, layout, axis);
    return {file, layout, axis, flux_};
  }

  std::string fault(const std::string& bytes) {
    try {
      sampler(bytes);
    } catch (const core::ConfigError& error) {
      EXPECT_EQ(error.faults().size(), 1u);
      return error.what();
    }
    return "none";
  }

  TempFolder folder_;
  RayFlux flux_;
};

/// Rays that carry their number in x. Even fluxes, one very bright ray in a block of faint ones (which the rejection
/// seldom finds), dark rays and rays that go back.
TEST_F(RaySamplerTest, RaysComeWithTheOddsOfTheirFlux) {
  Zemax file;
  std::vector<double> expected;
  constexpr int kRays = 3000;  // three blocks
  for (int i = 0; i < kRays; ++i) {
    double flux = 1.0 + 0.5 * std::sin(0.1 * i);
    if (i >= 1024 && i < 2048) flux = i == 1500 ? 900.0 : 0.01;
    if (i % 17 == 0) flux = 0.0;
    const bool back = i % 5 == 0;
    file.rays.push_back(ray(i, 0, 0, back ? 120 : 40, i, flux));
    expected.push_back(back ? 0.0 : flux);
  }
  const RaySampler rays = sampler(file.bytes());
  const double forward = std::accumulate(expected.begin(), expected.end(), 0.0);
  // 0.1 % is asked for; single-precision rays summed in double precision are far better.
  EXPECT_NEAR(flux_.forward, forward, 1e-6 * forward);
  EXPECT_GT(flux_.backward, 0.0);
  EXPECT_EQ(flux_.cumulative.size(), 3u);
  constexpr int kSamples = 200000;
  std::vector<double> counts(kRays, 0.0);
  core::PhotonRng rng({20260109, 0, 0}, 0);
  for (int i = 0; i < kSamples; ++i) {
    const FileRay drawn = rays.sample(rng);
    ASSERT_GT(drawn.direction.z(), 0.0);
    ASSERT_NEAR(drawn.direction.norm(), 1.0, 1e-12);
    counts[static_cast<std::size_t>(std::lround(drawn.position.x()))] += 1.0;
  }
  for (std::size_t i = 0; i < kRays; ++i) {
    ASSERT_TRUE(expected[i] > 0.0 || counts[i] == 0.0) << i;
    expected[i] *= kSamples / forward;
  }
  EXPECT_GT(chi_square_test(counts, expected).p_value, 1e-3);
}

TEST_F(RaySamplerTest, APhotonHasItsRayWhateverWasDrawnBefore) {
  Zemax file;
  for (int i = 0; i < 5000; ++i) file.rays.push_back(ray(i, 0, 0, i % 80, i, 1 + i % 7));
  const RaySampler rays = sampler(file.bytes());
  const auto draw = [&](std::uint64_t photon) {
    core::PhotonRng rng({3, 0, 0}, photon);
    return rays.sample(rng).position.x();
  };
  const double first = draw(77);
  for (std::uint64_t i = 0; i < 50; ++i) draw(i);
  EXPECT_EQ(draw(77), first);
}

TEST_F(RaySamplerTest, UnitsAreConverted) {
  Zemax file;
  file.unit = 1;  // inches
  file.rays = {ray(1, 2, 3, 0, 0, 1)};
  core::PhotonRng rng({3, 0, 0}, 0);
  EXPECT_NEAR((sampler(file.bytes()).sample(rng).position - Vec3(25.4, 50.8, 76.2)).norm(), 0.0, 1e-5);
}

TEST_F(RaySamplerTest, AxesTurnTheFileProperly) {
  const Vec3 units[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (const auto& [axis, ahead] : {std::pair(RayFileAxis::kPlusX, Vec3(1, 0, 0)),
                                    {RayFileAxis::kMinusX, {-1, 0, 0}},
                                    {RayFileAxis::kPlusY, {0, 1, 0}},
                                    {RayFileAxis::kMinusY, {0, -1, 0}},
                                    {RayFileAxis::kPlusZ, {0, 0, 1}},
                                    {RayFileAxis::kMinusZ, {0, 0, -1}}}) {
    EXPECT_EQ(into_frame(axis, ahead), Vec3(0, 0, 1));
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.col(i) = into_frame(axis, units[i]);
    EXPECT_NEAR(m.determinant(), 1.0, 1e-12);  // a turn, no mirror image
    EXPECT_NEAR((m * m.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
  }
}

TEST_F(RaySamplerTest, FaultyRaysAreTold) {
  const auto with = [](std::size_t number, float value) {
    Zemax file;
    file.rays = {ray(0, 0, 0, 10, 20, 1), ray(1, 0, 0, 30, 40, 2), ray(2, 0, 0, 30, 40, 2)};
    file.rays[1][number] = value;
    return file.bytes();
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(fault(with(0, 0)), "none");
  EXPECT_THAT(fault(with(0, nan)), HasSubstr("ray 2: position: must be three numbers"));
  EXPECT_THAT(fault(with(1, infinity)), HasSubstr("ray 2: position"));
  EXPECT_THAT(fault(with(2, 1e9F)), HasSubstr("ray 2: position"));
  EXPECT_THAT(fault(with(3, nan)), HasSubstr("ray 2: direction: must be a unit vector"));
  EXPECT_THAT(fault(with(5, 2.0F)), HasSubstr("ray 2: direction"));
  EXPECT_THAT(fault(with(6, -1.0F)), HasSubstr("ray 2: flux: must not be negative, got -1"));
  EXPECT_THAT(fault(with(6, nan)), HasSubstr("ray 2: flux"));
  EXPECT_THAT(fault(with(6, infinity)), HasSubstr("ray 2: flux"));
  Zemax dark;
  dark.rays = {ray(0, 0, 0, 10, 20, 0)};
  EXPECT_THAT(fault(dark.bytes()), HasSubstr("must hold rays with a flux above 0"));
  Zemax back;
  back.rays = {ray(0, 0, 0, 170, 20, 1)};
  EXPECT_THAT(fault(back.bytes()), HasSubstr("got all against it"));
}

TEST_F(RaySamplerTest, FaultyPolarizationIsTold) {
  const auto with = [](std::vector<float> stokes) {
    Tm25 file;
    file.flags = {1, 1, 1, 0, 0, 1, 0, 0};
    file.rays = {ray(0, 0, 0, 0, 0, 1)};
    file.rays[0].insert(file.rays[0].end(), stokes.begin(), stokes.end());
    return file.bytes();
  };
  EXPECT_EQ(fault(with({0.6F, 0.0F, 0.8F, 1, 0, 0})), "none");
  EXPECT_EQ(fault(with({0, 0, 0, 0, 0, 0})), "none");
  EXPECT_THAT(fault(with({0.9F, 0.0F, 0.8F, 1, 0, 0})), HasSubstr("degree of polarization above 1"));
  EXPECT_THAT(fault(with({0.5F, 0, 0, 0, 0, 1})), HasSubstr("polarization axis: must be across the direction"));
  EXPECT_THAT(fault(with({0.5F, 0, 0, 0, 0, 0})), HasSubstr("polarization axis"));
  EXPECT_THAT(fault(with({std::numeric_limits<float>::quiet_NaN(), 0, 0, 1, 0, 0})), HasSubstr("Stokes"));
}

TEST_F(RaySamplerTest, AFileThatChangedIsRefused) {
  Zemax file;
  file.rays = {ray(0, 0, 0, 10, 20, 1)};
  const auto path = write(file.bytes());
  const RayFileLayout layout = read_zemax_head(path);
  const RayFlux flux = scan_rays(path, layout, RayFileAxis::kPlusZ);
  std::filesystem::resize_file(path, 215);
  EXPECT_THROW(RaySampler(path, layout, RayFileAxis::kPlusZ, flux), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests

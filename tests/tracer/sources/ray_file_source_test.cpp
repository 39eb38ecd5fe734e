#include "tracer/sources/ray_file_source.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/sampling.h"
#include "tests/support/chi_square.h"
#include "tests/support/ray_files.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::kPi;
using core::Vec3;
using ::testing::HasSubstr;

const char* const kPlate =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, sources: [{kind: ray_file";

class RayFileSourceTest : public ::testing::Test {
 protected:
  std::string keys(const std::string& bytes, const std::string& more) {
    write_text(folder_ / "rays.dat", bytes);
    return std::string(kPlate) + ", file: " + (folder_ / "rays.dat").string() + more + "}]";
  }
  BacklightSpec spec(const std::string& bytes, const std::string& more) { return backlight_of(keys(bytes, more)); }

  std::string fault(const std::string& bytes, const std::string& more) {
    try {
      spec(bytes, more);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "none";
  }

  Photon one(const std::string& bytes, const std::string& more) {
    const BacklightSpec s = spec(bytes, more);
    core::PhotonRng rng({1, 0, 0}, 0);
    return s.sources.front()->emit(rng);
  }

  TempFolder folder_;
};

Zemax single(double x, double y, double z, double theta, double phi) {
  Zemax file;
  file.rays = {ray(x, y, z, theta, phi, 2.5)};
  return file;
}

TEST_F(RayFileSourceTest, FluxIsThatOfTheFileUnlessGiven) {
  Zemax zemax;
  Tm25 tm25;
  for (int i = 0; i < 1000; ++i) {
    zemax.rays.push_back(ray(0, 0, 0, i < 200 ? 100 : 30, i, 0.01));
    tm25.rays.push_back(zemax.rays.back());
  }
  for (const std::string& bytes : {zemax.bytes(), tm25.bytes()}) {
    const BacklightSpec s = spec(bytes, "");
    EXPECT_NEAR(s.sources.front()->flux(), 8.0, 8e-3);  // forward rays only
    EXPECT_THAT(s.sources.front()->note(), HasSubstr("20 % of the flux of the ray file goes away"));
    EXPECT_NEAR(spec(bytes, ", count: 3, pitch_mm: 2").sources.front()->flux(), 24.0, 24e-3);
    EXPECT_EQ(spec(bytes, ", count: 3, pitch_mm: 2, flux_lm: 2").sources.front()->flux(), 6.0);
  }
  // In watts, with the luminous flux of the whole in the head.
  tm25.flags = {1, 1, 1, 0, 0, 0, 0, 0};
  EXPECT_THAT(fault(tm25.bytes(), ""), HasSubstr("flux_lm: must be given, as the file tells its flux in W only"));
  tm25.luminous = 100.0F;
  EXPECT_NEAR(spec(tm25.bytes(), "").sources.front()->flux(), 80.0, 0.08);
}

/// The plane stands 0.02 mm before the left face; the file's x runs along +y there, its y along +z.
TEST_F(RayFileSourceTest, RaysStartWhereTheirLineCrossesThePlane) {
  const Photon straight = one(single(1, 0.1, 5, 0, 0).bytes(), "");
  EXPECT_NEAR((straight.position - Vec3(-0.02, 6.0, 0.4)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((straight.light.frame.k - Vec3(1, 0, 0)).norm(), 0.0, 1e-6);
  const Photon oblique = one(single(0, 0, 0.3, 45, 0).bytes(), "");  // back along its line by 0.3 mm
  EXPECT_NEAR((oblique.position - Vec3(-0.02, 4.7, 0.3)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((oblique.light.frame.k - Vec3(1, 1, 0).normalized()).norm(), 0.0, 1e-6);
  const Photon lifted = one(single(0, 0, 0.3, 45, 0).bytes(), ", origin_mm: [0.5, 0, 0.3]");
  EXPECT_NEAR((lifted.position - Vec3(-0.02, 4.5, 0.3)).norm(), 0.0, 1e-6);
  const Photon turned = one(single(1, 0, 0, 45, 0).bytes(), ", turn_deg: 90, across_mm: 0.1, at_mm: [2]");
  EXPECT_NEAR((turned.position - Vec3(-0.02, 2.0, 1.1)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((turned.light.frame.k - Vec3(1, 0, 1).normalized()).norm(), 0.0, 1e-6);
  const Photon along_x = one(single(0, 1, 0, 90, 0).bytes(), ", axis: +x");
  EXPECT_NEAR((along_x.light.frame.k - Vec3(1, 0, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((along_x.position - Vec3(-0.02, 6.0, 0.3)).norm(), 0.0, 1e-6);  // its y now runs along the face
}

TEST_F(RayFileSourceTest, StandsAtEveryFace) {
  struct Case {
    const char* face;
    Vec3 position, k;
  };
  const double s = std::sqrt(0.5);
  const Case cases[] = {{"left", {-0.1, 6, 0.3}, {s, s, 0}},   {"right", {20.1, 4, 0.3}, {-s, -s, 0}},
                        {"front", {9, -0.1, 0.3}, {-s, s, 0}}, {"back", {11, 10.1, 0.3}, {s, -s, 0}},
                        {"bottom", {11, 5, -0.1}, {s, 0, s}},  {"top", {9, 5, 0.7}, {-s, 0, -s}}};
  for (const Case& c : cases) {
    const Photon photon = one(single(1, 0, 0, 45, 0).bytes(), std::string(", gap_mm: 0.1, face: ") + c.face);
    EXPECT_NEAR((photon.position - c.position).norm(), 0.0, 1e-6) << c.face << " " << photon.position.transpose();
    EXPECT_NEAR((photon.light.frame.k - c.k).norm(), 0.0, 1e-6) << c.face << " " << photon.light.frame.k.transpose();
  }
}

TEST_F(RayFileSourceTest, PlacesShareTheLight) {
  const BacklightSpec s = spec(single(0, 0, 0, 0, 0).bytes(), ", at_mm: [1, 4, 9]");
  std::vector<double> counts(3, 0.0);
  core::PhotonRng rng({20260110, 0, 0}, 0);
  constexpr int kPhotons = 30000;
  for (int i = 0; i < kPhotons; ++i) {
    const double y = s.sources.front()->emit(rng).position.y();
    ++counts[y < 2 ? 0 : y < 5 ? 1 : 2];
  }
  EXPECT_GT(chi_square_test(counts, std::vector<double>(3, kPhotons / 3.0)).p_value, 1e-3);
}

TEST_F(RayFileSourceTest, PolarizationIsThatOfTheFile) {
  Tm25 file;
  file.flags = {1, 1, 1, 0, 0, 1, 0, 0};
  file.rays = {ray(0, 0, 0, 0, 0, 1)};
  file.rays[0].insert(file.rays[0].end(), {0.5F, 0.3F, -0.2F, 0, 1, 0.2F});
  const Photon photon = one(file.bytes(), ", flux_lm: 1");
  EXPECT_NEAR(photon.light.Q, 0.5, 1e-6);
  EXPECT_NEAR(photon.light.U, 0.3, 1e-6);
  EXPECT_NEAR(photon.light.V, -0.2, 1e-6);
  EXPECT_EQ(photon.light.I, 1.0);
  EXPECT_NEAR((photon.light.frame.e1 - Vec3::UnitZ()).norm(), 0.0, 1e-6);  // y of the file, across the ray
}

/// Rays of a Lambertian square in a file come out of the plane as those of the same square as an LED.
TEST_F(RayFileSourceTest, LambertianRaysAreALambertianSource) {
  Zemax file;
  core::PhotonRng writer({20260111, 0, 0}, 0);
  constexpr int kRays = 20000;
  for (int i = 0; i < kRays; ++i) {
    const double u = writer.uniform();
    const Vec3 k = core::sample_lambertian(u, writer.uniform());
    // Half of them start above, half below the plane, each on its own line through the square; fluxes differ.
    const double shift = i % 2 == 0 ? 0.5 : -0.5;
    const Vec3 p = Vec3(writer.uniform() - 0.5, 0.4 * (writer.uniform() - 0.5), 0) + shift / k.z() * k;
    const auto f = [](double v) { return static_cast<float>(v); };
    if (p.norm() > 1e3) continue;  // single precision of the file
    file.rays.push_back({f(p.x()), f(p.y()), f(p.z()), f(k.x()), f(k.y()), f(k.z()), f(writer.uniform())});
  }
  const BacklightSpec s = spec(file.bytes(), "");
  // The file's own rays are a sample: with fluxes uniform in [0, 1] their noise adds 4/3 photons / rays to the variance
  // of a count, relative; dividing counts and expectation by that excess takes it out of the statistic.
  std::vector<double> counts(20, 0.0);
  core::PhotonRng rng({20260112, 0, 0}, 0);
  constexpr int kPhotons = 20000;
  for (int i = 0; i < kPhotons; ++i) {
    const Photon photon = s.sources.front()->emit(rng);
    ASSERT_NEAR(photon.position.y(), 5.0, 0.501);
    ASSERT_NEAR(photon.position.z(), 0.3, 0.201);
    ++counts[static_cast<std::size_t>(std::min(19.0, 20.0 * photon.light.frame.k.x() * photon.light.frame.k.x()))];
  }
  for (double& count : counts) count /= 1.0 + 4.0 / 3.0 * kPhotons / kRays;
  double sum = 0.0;
  for (const double count : counts) sum += count;
  EXPECT_GT(chi_square_test(counts, std::vector<double>(20, sum / 20)).p_value, 1e-3);
}

TEST_F(RayFileSourceTest, TracesTheSameOnAnyNumberOfThreads) {
  Zemax file;
  for (int i = 0; i < 3000; ++i) file.rays.push_back(ray(0.001 * i, 0, 0, i % 89, 7 * i, 1 + i % 11));
  const std::string backlight = keys(file.bytes(), ", count: 2, pitch_mm: 3");
  const Traced one_thread(backlight, {20000, 5, 20, 1});
  const Traced four(backlight, {20000, 5, 20, 4});
  EXPECT_EQ(one_thread.accounted(), one_thread.photons());
  for (const Side side : {Side::kLeft, Side::kRight, Side::kFront, Side::kBack, Side::kBottom, Side::kTop}) {
    EXPECT_EQ(one_thread.escaped(side), four.escaped(side));
  }
  EXPECT_GT(one_thread.escaped(Side::kRight), 0.3 * one_thread.photons());
}

TEST_F(RayFileSourceTest, Faults) {
  const std::string good = single(0, 0, 0, 10, 0).bytes();
  EXPECT_EQ(fault(good, ""), "none");
  EXPECT_THAT(fault("rubbish", ""), HasSubstr("sources[0].file: "));
  EXPECT_THAT(fault(good, ", format: tm25"), HasSubstr("must be at least 36288 bytes"));
  EXPECT_THAT(fault(good, ", axis: -z"), HasSubstr("got all against it"));
  EXPECT_THAT(fault(good, ", axis: z"), HasSubstr("axis: must be one of"));
  EXPECT_THAT(fault(good, ", at_mm: [11]"), HasSubstr("at_mm: the places must lie on the left face, 0 to 10 mm"));
  EXPECT_THAT(fault(good, ", at_mm: [1], count: 2"), HasSubstr("at_mm: must be left out where count or pitch_mm"));
  EXPECT_THAT(fault(good, ", count: 3, pitch_mm: 6"), HasSubstr("pitch_mm: the places must lie on the left face"));
  EXPECT_THAT(fault(good, ", across_mm: 0.7"), HasSubstr("across_mm: must lie on the left face, 0 to 0.6 mm"));
  EXPECT_THAT(fault(good, ", flux_lm: 0"), HasSubstr("flux_lm"));
  EXPECT_THAT(fault(good, ", origin_mm: [1, 2]"), HasSubstr("origin_mm: must hold 3 numbers"));
}

// ---------------------------------------------------------------- a file larger than memory should hold

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// 2 GiB of rays, written anew; traced within 500 MB of memory (the high-water mark of this process, which runs this
/// test alone under ctest).
TEST(RayFileSourceLong, TwoGigabytesAreTracedInLittleMemory) {
  const TempFolder folder;
  constexpr std::uint64_t kBytes = std::uint64_t{2} << 30;
  ASSERT_GT(std::filesystem::space(folder.path()).available, kBytes + (std::uint64_t{1} << 30)) << "3 GiB of disk";
  Tm25 file;
  constexpr std::uint64_t kBlock = 4096;
  file.told_rays = (kBytes - 36288) / 28 / kBlock * kBlock;
  {
    std::ofstream out(folder / "large.tm25ray", std::ios::binary);
    out << file.head();
    ByteWriter block;
    for (std::uint64_t i = 0; i < kBlock; ++i) {
      block.put(ray(0.0001 * static_cast<double>(i), 0, 0, static_cast<double>(i % 80), static_cast<double>(i), 1e-6));
    }
    for (std::uint64_t i = 0; i < file.told_rays / kBlock; ++i) out << block.bytes();
    ASSERT_TRUE(out.good());
  }
  const Traced traced(std::string(kPlate) + ", file: " + (folder / "large.tm25ray").string() + "}]",
                      {200000, 5, 20, 4});
  EXPECT_NEAR(traced.scene().spec.sources.front()->flux(), 1e-6 * static_cast<double>(file.told_rays), 1e-3 * 77);
  EXPECT_EQ(traced.accounted(), traced.photons());
  rusage usage{};
  ASSERT_EQ(::getrusage(RUSAGE_SELF, &usage), 0);
  RecordProperty("max_rss_mib", static_cast<int>(usage.ru_maxrss / 1024));
  EXPECT_LT(usage.ru_maxrss, 500 * 1024) << "KiB";
}

#endif

}  // namespace
}  // namespace evenglow::tests

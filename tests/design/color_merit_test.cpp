#include "design/problem/color_merit.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/light/cie_1931.h"
#include "core/light/color.h"
#include "design/problem/pair_statistic.h"

/// Displays lit by two wavelengths whose shares are known in each cell: so are u', v' and all distances. Counts are
/// Poisson's. Seeds fixed; what each test may raise by chance is said at it.
namespace evenglow::design {
namespace {

using core::Vec2;
using core::Vec3;

const core::CellGrid kCells = core::CellGrid::over(12, 6, 0.0, 0.0, 12.0, 6.0);
const Vec3 kBlue = core::color_matching(460.0), kYellow = core::color_matching(570.0);

struct Display {
  double tilt = 0.0;      ///< relative change of the blue share from the left to the right edge
  double photons = 4000;  ///< of each wavelength in a cell and batch
  double common = 0.0;    ///< relative noise of the blue light of a whole batch, which all cells share
  std::size_t batches = 40;

  double blue(std::size_t cell) const {
    return photons * (1.0 + tilt * ((static_cast<double>(cell % 12) + 0.5) / 12.0 - 0.5));
  }
  Vec3 expected(std::size_t cell) const { return blue(cell) * kBlue + photons * kYellow; }
  Vec2 mean() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < kCells.size(); ++i) sum += expected(i);
    return core::chromaticity_uv(sum);
  }
  double delta(std::size_t cell) const { return (core::chromaticity_uv(expected(cell)) - mean()).norm(); }
  double mean_square() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kCells.size(); ++i) sum += delta(i) * delta(i) / static_cast<double>(kCells.size());
    return sum;
  }
};

struct Tallies {
  core::Tally x{kCells.size()}, y{kCells.size()}, z{kCells.size()};
};

Tallies draw(const Display& display, std::mt19937_64& random) {
  Tallies tallies;
  std::normal_distribution<double> normal;
  for (std::size_t b = 0; b < display.batches; ++b) {
    std::vector<double> x, y, z;
    const double level = 1.0 + display.common * normal(random);
    for (std::size_t i = 0; i < kCells.size(); ++i) {
      std::poisson_distribution<int> blue(display.blue(i) * level), yellow(display.photons);
      const Vec3 xyz = blue(random) * kBlue + yellow(random) * kYellow;
      x.push_back(xyz.x());
      y.push_back(xyz.y());
      z.push_back(xyz.z());
    }
    tallies.x.add_batch(std::move(x));
    tallies.y.add_batch(std::move(y));
    tallies.z.add_batch(std::move(z));
  }
  return tallies;
}

ColorJudgment judge(const Tallies& t) {
  return judge_color(kCells, {t.x, t.y, t.z}, kBlue + kYellow);
}

class Pulls {
 public:
  void add(const core::Estimate& estimate, double expected) { add((estimate.value - expected) / estimate.se); }
  void add(double pull) {
    ++count_;
    sum_ += pull;
    squares_ += pull * pull;
  }
  double mean() const { return sum_ / count_; }
  double width() const { return std::sqrt(squares_ / count_ - mean() * mean()); }

 private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

/// 300 repetitions of one cell: the width has a standard error of 0.041, and Student's t of 39 makes it 1.026; 0.15 is
/// 3 of them (false alarm 0.003 each). Errors that take X, Y and Z as independent are larger by more than a half here.
TEST(ColorMerit, PullsOfColorAndDistanceHaveUnitWidth) {
  const Display display{0.3, 400.0};
  std::mt19937_64 random(21);
  Pulls u, v, delta, mean_u;
  const Vec2 edge = core::chromaticity_uv(display.expected(0));
  for (int i = 0; i < 300; ++i) {
    const ColorJudgment color = judge(draw(display, random));
    u.add({color.u.values[0], color.u_se.values[0]}, edge.x());
    v.add({color.v.values[0], color.v_se.values[0]}, edge.y());
    delta.add({color.delta.values[0], color.delta_se.values[0]}, display.delta(0));
    mean_u.add(color.mean.u, display.mean().x());
  }
  for (const Pulls* pulls : {&u, &v, &delta, &mean_u}) {
    std::printf("pull %.3f +- %.3f\n", pulls->mean(), pulls->width());
    EXPECT_NEAR(pulls->width(), 1.0, 0.15);
    EXPECT_LT(std::abs(pulls->mean()), 0.25);
  }
}

/// Squared RMS with the noise taken off: no bias and unit pulls, whether the color is even or not, and with noise that
/// all cells share (which moves the mean color, not the distances, of an even display). 300 repetitions; the pulls of a
/// square that is all noise are skew: 0.2.
TEST(ColorMerit, PullsOfTheSquaredRmsHaveUnitWidth) {
  for (const Display& display :
       {Display{0.0, 400.0}, Display{0.0, 400.0, 0.02}, Display{0.05, 400.0}, Display{0.3, 400.0}}) {
    std::mt19937_64 random(12);
    Pulls pulls;
    double values = 0.0, raw = 0.0;
    for (int i = 0; i < 300; ++i) {
      const ColorJudgment color = judge(draw(display, random));
      const core::Estimate square = signed_square(color.rms_corrected);
      pulls.add(square, display.mean_square());
      values += square.value / 300.0;
      raw += color.rms / 300.0;
    }
    std::printf("tilt %.2f common %.2f: raw %.5f, corrected %.5f, true %.5f, pull %.3f +- %.3f\n", display.tilt,
                display.common, raw, std::copysign(std::sqrt(std::abs(values)), values),
                std::sqrt(display.mean_square()), pulls.mean(), pulls.width());
    EXPECT_NEAR(pulls.width(), 1.0, 0.2);
    EXPECT_LT(std::abs(pulls.mean()), 0.3);
    if (display.tilt < 0.1) {
      EXPECT_GT(raw * raw, display.mean_square() * 1.02);
    }
  }
}

/// The maximum of the map is too large where noise makes it; that of the two halves is not.
TEST(ColorMerit, TheMaximumOfTheHalvesIsNotMadeByNoise) {
  std::mt19937_64 random(13);
  double raw = 0.0, split = 0.0;
  for (int i = 0; i < 100; ++i) {
    const ColorJudgment color = judge(draw({0.0, 100.0}, random));
    raw += color.max.value / 100.0;
    split += color.max_corrected.value * std::abs(color.max_corrected.value) / 100.0;
  }
  EXPECT_GT(raw, 0.005);
  EXPECT_LT(std::abs(split), std::pow(0.25 * raw, 2));  // its spread is about 0.1 of the square of raw
  const Display uneven{0.3, 40000.0};
  const ColorJudgment color = judge(draw(uneven, random));
  EXPECT_NEAR(color.max_corrected.value, uneven.delta(0), 4.0 * color.max_corrected.se);
  EXPECT_LT(color.max_corrected.se, 0.05 * uneven.delta(0));
  EXPECT_TRUE(color.max_x == 0.5 || color.max_x == 11.5) << color.max_x;
}

TEST(ColorMerit, KnownColorsWithoutNoise) {
  Display display{0.2};
  Tallies t;
  for (int b = 0; b < 6; ++b) {
    std::vector<double> x, y, z;
    for (std::size_t i = 0; i < kCells.size(); ++i) {
      x.push_back(display.expected(i).x());
      y.push_back(display.expected(i).y());
      z.push_back(display.expected(i).z());
    }
    t.x.add_batch(x), t.y.add_batch(y), t.z.add_batch(z);
  }
  const ColorJudgment color = judge(t);
  for (std::size_t i = 0; i < kCells.size(); ++i) {
    EXPECT_NEAR(color.u.values[i], core::chromaticity_uv(display.expected(i)).x(), 1e-12);
    EXPECT_NEAR(color.delta.values[i], display.delta(i), 1e-12);
  }
  EXPECT_NEAR(color.rms, std::sqrt(display.mean_square()), 1e-12);
  EXPECT_NEAR(color.rms_corrected.value, color.rms, 1e-9);
  EXPECT_NEAR(color.max.value, display.delta(0), 1e-12);
  EXPECT_NEAR(color.shift.value, 0.0, 1e-9);  // the tilt leaves the sum as it was
  EXPECT_NEAR(color.emitted.u.value, core::chromaticity_uv(kBlue + kYellow).x(), 1e-15);
}

TEST(ColorMerit, DarkCellsAreLeftOut) {
  Tallies t;
  for (int b = 0; b < 6; ++b) {
    std::vector<double> ones(kCells.size(), 1.0);
    ones[3] = 0.0;
    t.x.add_batch(ones), t.y.add_batch(ones), t.z.add_batch(ones);
  }
  const ColorJudgment color = judge(t);
  EXPECT_EQ(color.dark_cells, 1U);
  EXPECT_TRUE(std::isnan(color.u.values[3]));
  EXPECT_NEAR(color.rms, 0.0, 1e-12);
  Tallies dark;
  for (int b = 0; b < 6; ++b) {
    const std::vector<double> none(kCells.size(), 0.0);
    dark.x.add_batch(none), dark.y.add_batch(none), dark.z.add_batch(none);
  }
  EXPECT_EQ(judge(dark).dark_cells, kCells.size());
  EXPECT_THROW(judge(Tallies{}), core::Error);
}

}  // namespace
}  // namespace evenglow::design

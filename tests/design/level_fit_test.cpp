#include "design/engine/level_fit.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

LevelData data_of(const LevelCurve& truth, double se, std::mt19937_64* random = nullptr) {
  LevelData data{{0.03, 0.05, 0.08, 0.12, 0.19, 0.3}, Eigen::VectorXd(6), Eigen::MatrixXd::Identity(6, 6) * se * se};
  std::normal_distribution<double> normal(0.0, se);
  for (int i = 0; i < 6; ++i)
    data.efficiency[i] =
        truth.at(data.levels[static_cast<std::size_t>(i)]) + (random != nullptr ? normal(*random) : 0.0);
  return data;
}

TEST(LevelFit, FindsCurvesOfItsFamily) {
  for (const LevelCurve& truth : {LevelCurve{0.7, 0.04, 1.0, 0.0, 0.0}, LevelCurve{0.6, 0.1, 2.0, 0.5, 0.0},
                                  LevelCurve{0.5, 0.06, std::numeric_limits<double>::infinity(), 0.2, 0.0}}) {
    const LevelCurve fit = fit_level_curve(data_of(truth, 1e-4));
    for (const double level : {0.03, 0.06, 0.1, 0.25}) EXPECT_NEAR(fit.at(level), truth.at(level), 2e-4);
  }
}

TEST(LevelFit, KneeOfAnExponentialInClosedForm) {
  const LevelCurve curve{0.7, 0.04, std::numeric_limits<double>::infinity(), 0.0, 0.0};
  const double expected = -0.04 * std::log1p(-0.98 * -std::expm1(-0.3 / 0.04));
  EXPECT_NEAR(knee_of(curve, 0.98, 0.03, 0.3), expected, 1e-6);
  EXPECT_NEAR(level_of(curve, 0.35, 0.01, 0.3), 0.04 * std::log(2.0), 1e-6);
  EXPECT_EQ(level_of(curve, 0.9, 0.03, 0.3), 0.3);
  EXPECT_EQ(level_of(curve, 0.1, 0.03, 0.3), 0.03);
}

TEST(LevelFit, KneeLiesBeforeADecline) {
  // Grows to its maximum near 0.1 and falls by a third after it: the knee is on the rising side.
  const LevelCurve curve{0.7, 0.03, std::numeric_limits<double>::infinity(), 1.5, 0.0};
  const double knee = knee_of(curve, 0.98, 0.02, 0.3);
  EXPECT_LT(knee, 0.1);
  EXPECT_LT(curve.at(0.9 * knee), curve.at(knee));
}

TEST(LevelFit, ErrorOfTheKneeIsThatOfRepetitions) {
  // 200 repetitions: the width of the pulls has a standard error of 5 %; 0.7 to 1.4 leaves room for the shape k, which
  // the error takes as known.
  const LevelCurve truth{0.7, 0.05, 2.0, 0.0, 0.0};
  const double knee = knee_of(truth, 0.98, 0.03, 0.3);
  std::mt19937_64 random(5);
  double sum = 0.0, squares = 0.0, told = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Knee found = find_knee(data_of(truth, 0.0005, &random), 0.98, 0.03, 0.3);
    const double rest = std::log(found.level / knee);
    sum += rest / 200;
    squares += rest * rest / 200;
    told += found.log_se / 200;
  }
  EXPECT_LT(std::abs(sum), 0.02);
  const double width = std::sqrt(squares - sum * sum);
  EXPECT_GT(told, 0.7 * width);
  EXPECT_LT(told, 1.6 * width);
}

}  // namespace
}  // namespace evenglow::design

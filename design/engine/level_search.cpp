#include "design/engine/level_search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "design/engine/level_color.h"
#include "design/engine/level_fit.h"
#include "design/problem/color_bound.h"
#include "design/problem/density_limits.h"

namespace evenglow::design {
namespace {

constexpr int kLevels = 6;
constexpr double kReach = 3.0;      // factor up and down
constexpr double kRoom = 0.75;      // of the upper limit that the fullest cell may use
constexpr double kHeld = 1.001;     // a density below this, over its lower limit, is held by it
constexpr double kTooNarrow = 1.1;  // factor between highest and lowest level
constexpr double kShare = 0.98;     // of the best efficiency
constexpr double kWantedError = 0.05;
constexpr double kWantedColorError = 0.1;  // over its bound
constexpr int kRounds = 3;
constexpr double kGrowth = 4.0;
constexpr std::uint32_t kFirstStep = 0x80000000U;  // random numbers of their own, the same for all levels

struct Factors {
  double low;
  double high;
};

/// How far the density can be scaled without bringing cells to a limit.
Factors room_of(const tracer::DensityField& density, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, density.cells.grid);
  Factors room{1.0 / kReach, kReach};
  for (std::size_t i = 0; i < density.cells.values.size(); ++i) {
    const double value = density.cells.values[i];
    room.high = std::min(room.high, kRoom * limits.largest.values[i] / value);
    if (value > kHeld * limits.least.values[i]) room.low = std::max(room.low, limits.least.values[i] / value);
  }
  room.low = std::min(room.low, 1.0);
  room.high = std::max(room.high, 1.0);
  return room;
}

tracer::DensityField scaled(tracer::DensityField density, double factor, const DesignSpec& spec) {
  for (double& value : density.cells.values) value *= factor;
  const CellLimits limits = cell_limits(spec, density.cells.grid);
  return within(limits, std::move(density));
}

/// Covariance of the means of equally many batches; of single errors where there are none.
Eigen::MatrixXd covariance_of(const std::vector<Observation>& seen) {
  const auto n = static_cast<Eigen::Index>(seen.size());
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  const std::size_t batches = seen.front().efficiency_batches.size();
  if (batches < 2 * seen.size()) {
    for (Eigen::Index i = 0; i < n; ++i) c(i, i) = std::pow(seen[static_cast<std::size_t>(i)].efficiency.se, 2);
    return c;
  }
  Eigen::MatrixXd rest(n, static_cast<Eigen::Index>(batches));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& own = seen[static_cast<std::size_t>(i)].efficiency_batches;
    rest.row(i) = Eigen::Map<const Eigen::RowVectorXd>(own.data(), static_cast<Eigen::Index>(batches));
    rest.row(i).array() -= rest.row(i).mean();
  }
  return rest * rest.transpose() / static_cast<double>(batches * (batches - 1));
}

class Search {
 public:
  Search(const ForwardModel& model, const tracer::DensityField& density, const DesignSpec& spec)
      : model_(model), density_(density), spec_(spec), room_(room_of(density, spec)) {}

  bool narrow() const { return room_.high < kTooNarrow * room_.low; }

  /// False: interrupted.
  bool trace(std::uint64_t photons, std::uint32_t step) {
    std::vector<Observation> seen;
    data_.levels.clear();
    colors_.clear();
    for (int i = 0; i < kLevels; ++i) {
      const double factor = room_.low * std::pow(room_.high / room_.low, static_cast<double>(i) / (kLevels - 1));
      const tracer::DensityField candidate = scaled(density_, factor, spec_);
      auto observation = model_(candidate, photons, step);
      if (!observation) return false;
      data_.levels.push_back(candidate.cells.mean());
      spent_.photons += observation->photons;
      spent_.cpu_s += observation->cpu_s;
      spent_.wall_s += observation->wall_s;
      if (spec_.goal.color) {
        if (const auto color = color_rms(*observation)) colors_.push_back(*color);
      }
      seen.push_back(std::move(*observation));
    }
    data_.efficiency.resize(kLevels);
    for (int i = 0; i < kLevels; ++i) data_.efficiency[i] = seen[static_cast<std::size_t>(i)].efficiency.value;
    data_.covariance = covariance_of(seen);
    knee_ = find_knee(data_, kShare, data_.levels.front(), data_.levels.back());
    return true;
  }

  /// Are the errors of the knee and of the colors small enough?
  bool sure() const {
    const auto wide = [&](const core::Estimate& color) { return color.se > kWantedColorError * *spec_.goal.color; };
    return knee_.log_se <= kWantedError && std::none_of(colors_.begin(), colors_.end(), wide);
  }

  LevelChoice choice() const {
    LevelChoice choice = spent_;
    const double low = data_.levels.front();
    const double high = data_.levels.back();
    const bool bounded = spec_.goal.kind == "min_rms";
    double level = bounded ? level_of(knee_.curve, spec_.goal.efficiency, low, high) : knee_.level;
    const double wanted = level;
    ColorLevel colored;
    if (spec_.goal.color && colors_.size() == data_.levels.size()) {
      colored = level_for_color({data_.levels, colors_, *spec_.goal.color, bounded ? wanted : low}, wanted);
      level = colored.level;
    }
    choice.factor = level / density_.cells.mean();
    choice.log_se = knee_.log_se;
    const double step = 1.02;
    choice.slope = std::log(knee_.curve.at(level * step) / knee_.curve.at(level / step)) / (2.0 * std::log(step));
    choice.note = "Level of the density, efficiency at mean density";
    for (int i = 0; i < kLevels; ++i) {
      choice.note += fmt::format(" {:.3f}: {:.2f} +- {:.2f} %,", data_.levels[static_cast<std::size_t>(i)],
                                 100.0 * data_.efficiency[i], 100.0 * std::sqrt(data_.covariance(i, i)));
    }
    choice.note += bounded ? fmt::format(" chosen {:.4f}, the lowest that reaches {:.1f} % on the fitted curve.",
                                         wanted, 100.0 * spec_.goal.efficiency)
                           : fmt::format(
                                 " chosen {:.4f} +- {:.4f}, the lowest within 2 % of the best of the fitted "
                                 "curve.",
                                 wanted, wanted * knee_.log_se);
    choice.note += colored.note;
    return choice;
  }

 private:
  const ForwardModel& model_;
  const tracer::DensityField& density_;
  const DesignSpec& spec_;
  Factors room_;
  LevelData data_;
  std::vector<core::Estimate> colors_;  ///< of each level, where the color is bounded
  Knee knee_;
  LevelChoice spent_;
};

}  // namespace

std::optional<LevelChoice> choose_level(const ForwardModel& model, const tracer::DensityField& density,
                                        const DesignSpec& spec, std::uint64_t photons, std::uint64_t most) {
  Search search(model, density, spec);
  if (search.narrow()) {
    LevelChoice choice;
    choice.note =
        fmt::format("Level of the density: kept at {:.4f}, for the limits of the cells leave no room to either side.",
                    density.cells.mean());
    return choice;
  }
  for (int round = 0; round < kRounds; ++round) {
    if (!search.trace(photons, kFirstStep + static_cast<std::uint32_t>(round))) return std::nullopt;
    const auto more = static_cast<std::uint64_t>(kGrowth * static_cast<double>(photons));
    if (search.sure() || more > most) break;
    photons = more;
  }
  return search.choice();
}

}  // namespace evenglow::design

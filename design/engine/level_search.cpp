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
constexpr double kAtEnd = 1.001;
constexpr double kReaches = 0.999;  // of the wanted efficiency: reached
constexpr int kMostPlaces = 4;      // of the range of levels
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
    const double value = density.cells.values[i], largest = limits.largest.values[i];
    // What a limit holds already, or a map below the common one, is no bound for the others.
    if (value * kHeld < largest && largest >= spec.density_max)
      room.high = std::min(room.high, kRoom * largest / value);
    if (value > kHeld * limits.least.values[i]) room.low = std::max(room.low, limits.least.values[i] / value);
  }
  room.low = std::min(room.low, 1.0);
  room.high = std::max(room.high, 1.0);
  return room;
}

tracer::DensityField scaled(tracer::DensityField density, double factor, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, density.cells.grid);
  const double scale = scale_to_mean(density.cells, limits, factor * density.cells.mean());
  for (double& value : density.cells.values) value *= scale;
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

  /// The factor at which the levels should be tried anew, as what is looked for lies beyond those that were, with room
  /// left there; 1: it does not.
  double farther() const {
    const double low = data_.levels.front(), high = data_.levels.back();
    const bool room_above = room_.high >= kReach, room_below = room_.low <= 1.0 / kReach;
    const double level = wanted_level();
    if (room_above && (bounded() ? misses_goal() : rises_on(high))) return room_.high;
    return room_below && level <= kAtEnd * low ? room_.low : 1.0;
  }

  /// Are the errors of the knee and of the colors small enough?
  bool sure() const {
    const auto wide = [&](const core::Estimate& color) { return color.se > kWantedColorError * *spec_.goal.color; };
    return knee_.log_se <= kWantedError && std::none_of(colors_.begin(), colors_.end(), wide);
  }

  /// `spent`: before.
  LevelChoice choice(const LevelChoice& before) const {
    LevelChoice choice = spent_;
    choice.photons += before.photons;
    choice.cpu_s += before.cpu_s;
    choice.wall_s += before.wall_s;
    const double low = data_.levels.front();
    const double wanted = wanted_level();
    double level = wanted;
    ColorLevel colored;
    if (spec_.goal.color && colors_.size() == data_.levels.size()) {
      colored = level_for_color({data_.levels, colors_, *spec_.goal.color, bounded() ? wanted : low}, wanted);
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
    choice.note += reason() + colored.note;
    return choice;
  }
  const LevelChoice& spent() const { return spent_; }

 private:
  bool bounded() const { return spec_.goal.kind == "min_rms"; }
  double wanted_level() const {
    const double low = data_.levels.front(), high = data_.levels.back();
    return bounded() ? level_of(knee_.curve, spec_.goal.efficiency, low, high) : knee_.level;
  }
  bool misses_goal() const { return knee_.curve.at(wanted_level()) < kReaches * spec_.goal.efficiency; }
  /// Would levels above `high` be more than the 2 % better that the knee looks for?
  bool rises_on(double high) const { return kShare * knee_.curve.at(kReach * high) > knee_.curve.at(high); }

  std::string reason() const {
    const double level = wanted_level(), high = data_.levels.back();
    if (bounded() && misses_goal()) {
      return fmt::format(" chosen {:.4f}: no level that the limits of the cells allow reaches {:.1f} %.", level,
                         100.0 * spec_.goal.efficiency);
    }
    if (bounded()) {
      return fmt::format(" chosen {:.4f}, the lowest that reaches {:.1f} % on the fitted curve.", level,
                         100.0 * spec_.goal.efficiency);
    }
    if (rises_on(high)) {
      return fmt::format(" chosen {:.4f}: the efficiency still grows where the limits of the cells end the range.",
                         level);
    }
    return fmt::format(" chosen {:.4f} +- {:.4f}, the lowest within 2 % of the best of the fitted curve.", level,
                       level * knee_.log_se);
  }

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
  LevelChoice spent;
  double shift = 1.0;
  for (int place = 0;; ++place) {
    const tracer::DensityField middle = place == 0 ? density : scaled(density, shift, spec);
    Search search(model, middle, spec);
    if (search.narrow()) {
      spent.factor = shift;
      spent.note =
          fmt::format("Level of the density: kept at {:.4f}, for the limits of the cells leave no room to either side.",
                      middle.cells.mean());
      return spent;
    }
    std::uint64_t own = photons;
    for (int round = 0; round < kRounds; ++round) {
      if (!search.trace(own, kFirstStep + static_cast<std::uint32_t>(place * kRounds + round))) return std::nullopt;
      const auto more = static_cast<std::uint64_t>(kGrowth * static_cast<double>(own));
      if (search.sure() || search.farther() != 1.0 || more > most) break;
      own = more;
    }
    if (place == kMostPlaces - 1 || search.farther() == 1.0) {
      LevelChoice choice = search.choice(spent);
      choice.factor *= middle.cells.mean() / density.cells.mean();
      return choice;
    }
    shift *= search.farther();
    spent.photons += search.spent().photons;
    spent.cpu_s += search.spent().cpu_s;
    spent.wall_s += search.spent().wall_s;
  }
}

}  // namespace evenglow::design

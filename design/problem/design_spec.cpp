#include "design/problem/design_spec.h"

#include <algorithm>

#include <fmt/core.h>

#include "design/problem/target_keys.h"

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;

constexpr core::MatrixRange kMaskRange = {0.0, 1.0, "1 (the cell counts) or 0"};
constexpr core::MatrixRange kLimitRange = {0.0, 1.0, "a density in [0, 1]"};

void read_count_pair(const ConfigNode& node, const char* key, const char* help, double most, int& x, int& y) {
  const auto counts =
      node.numbers({key, help, Range::closed(1, most), 2, 2, {{static_cast<double>(x), static_cast<double>(y)}}, true});
  if (counts.size() != 2) return;
  x = static_cast<int>(counts[0]);
  y = static_cast<int>(counts[1]);
}

void read_spline(const ConfigNode& node, SplineSpec& spec) {
  read_count_pair(node, "coefficients", "coefficients of the profile along x and y", 12, spec.nx, spec.ny);
  if (spec.nx * spec.ny < 2) node.fault_at("coefficients", "must be at least two in all, got one");
  spec.method = node.choice({"method", "search of NLopt", {"bobyqa", "cobyla", "sbplx"}, std::string(spec.method)});
}

void read_updater(const ConfigNode& node, DesignSpec& spec) {
  spec.updater = node.choice({"updater",
                              "how the next density is proposed",
                              {"auto", "ratio_noise_aware", "path_reuse", "anderson", "coarse_newton", "gradient",
                               "ratio", "stochastic_approximation", "spline"},
                              std::string(spec.updater)});
  spec.power = node.number({"power", "exponent of target over luminance", {0, 2, true, false}, spec.power});
  spec.anderson_vectors = static_cast<int>(node.integer(
      {"anderson_vectors", "earlier steps that the acceleration may combine", 1, 8, spec.anderson_vectors}));
  read_spline(node.map("spline", "profile and search of the updater spline"), spec.spline);
  const ConfigNode newton = node.map("coarse_newton", "grid of the updater coarse_newton");
  read_count_pair(newton, "cells", "nodes of the coarse grid along x and y", 64, spec.coarse_newton.nx,
                  spec.coarse_newton.ny);
  if (spec.coarse_newton.nx * spec.coarse_newton.ny > 1024)
    newton.fault_at("cells",
                    fmt::format("must be at most 1024 in all, got {}", spec.coarse_newton.nx * spec.coarse_newton.ny));
  const ConfigNode gradient = node.map("gradient", "search of the updater gradient");
  spec.gradient.method =
      gradient.choice({"method", "search of NLopt", {"lbfgs", "mma"}, std::string(spec.gradient.method)});
  spec.gradient.evaluations = static_cast<int>(gradient.integer(
      {"evaluations", "values and gradients on the histories of a trace", 2, 1000, spec.gradient.evaluations}));
}

void read_limits(const ConfigNode& node, DesignSpec& spec) {
  const auto limits = node.numbers({"density",
                                    "least and largest density of a cell",
                                    Range::closed(0, 1),
                                    2,
                                    2,
                                    {{spec.density_min, spec.density_max}}});
  if (limits.size() == 2) {
    spec.density_min = limits[0];
    spec.density_max = limits[1];
    if (!(limits[0] > 0.0 && limits[0] < limits[1])) {
      node.fault_at("density",
                    fmt::format("must be two numbers, 0 < least < largest, got [{}, {}]", limits[0], limits[1]));
    }
  }
  const ConfigNode files = node.map("density_files", "limits cell by cell, as matrices over the plate");
  spec.least_map = read_map_key(files, {"least", "least density of each cell", std::string()}, kLimitRange);
  spec.largest_map = read_map_key(files, {"largest", "largest density of each cell", std::string()}, kLimitRange);
  const auto& largest = spec.largest_map.values;
  if (!largest.empty() && *std::min_element(largest.begin(), largest.end()) < spec.density_min) {
    files.fault_at("largest", fmt::format("must be at least the least density of all cells, {}, in every cell, got {}",
                                          spec.density_min, *std::min_element(largest.begin(), largest.end())));
  }
  const auto& least = spec.least_map.values;
  if (!least.empty() && *std::max_element(least.begin(), least.end()) > spec.density_max) {
    files.fault_at("least", fmt::format("must be at most the largest density of all cells, {}, in every cell, got {}",
                                        spec.density_max, *std::max_element(least.begin(), least.end())));
  }
  spec.neighbor_ratio =
      node.optional_number({"neighbor_ratio", "greatest ratio of the densities of neighboring cells; left out: any",
                            Range::closed(1.001, 1000)});
  spec.symmetry = node.choice({"symmetry",
                               "the density mirrors itself about the middle of the plate in x, in y, or both",
                               {"none", "x", "y", "both"},
                               std::string(spec.symmetry)});
}

void read_level(const ConfigNode& node, DesignSpec& spec) {
  spec.level =
      node.optional_number({"level",
                            "mean density over the plate; left out: the lowest within 2 % of the best efficiency",
                            {0, 1, true, false}});
  if (spec.level && (*spec.level < spec.density_min || *spec.level > spec.density_max)) {
    node.fault_at("level", fmt::format("must lie between the limits of the density, [{}, {}], got {}", spec.density_min,
                                       spec.density_max, *spec.level));
  }
  if (spec.level && spec.goal.kind != "even")
    node.fault_at("level", "must be left out with a goal that chooses it, got both");
  spec.pareto_levels =
      node.numbers({"pareto_levels", "mean densities at which evenglow pareto designs; left out: chosen",
                    Range{0, 1, true, true}, 0, 100, std::vector<double>{}});
  std::sort(spec.pareto_levels.begin(), spec.pareto_levels.end());
  for (const double level : spec.pareto_levels) {
    if (level >= spec.density_min && level <= spec.density_max) continue;
    node.fault_at("pareto_levels", fmt::format("must lie between the limits of the density, [{}, {}], got {}",
                                               spec.density_min, spec.density_max, level));
    break;
  }
}

}  // namespace

DesignSpec read_design(const ConfigNode& node) {
  DesignSpec spec;
  spec.target = read_target(node);
  spec.mask =
      read_map_key(node, {"mask", "matrix over the display: cells with 0 do not count", std::string()}, kMaskRange);
  if (!spec.mask.empty() && *std::max_element(spec.mask.values.begin(), spec.mask.values.end()) < 0.5)
    node.fault_at("mask", "must leave at least one cell, got none");
  spec.start = read_start(node);
  spec.goal = read_goal(node);
  read_updater(node, spec);
  spec.stop_rms =
      node.number({"stop_rms", "noise-corrected RMS non-uniformity to reach", {0, 1, true, false}, spec.stop_rms});
  spec.max_steps =
      static_cast<int>(node.integer({"max_steps", "largest number of steps after the start", 0, 1000, spec.max_steps}));
  read_limits(node, spec);
  read_level(node, spec);
  spec.verify_dots = node.choice({"verify",
                                  "what the finished design is proved with: none, or dots (the density becomes dots as "
                                  "the map dots says, is traced dot by dot and corrected by what that shows)",
                                  {"none", "dots"},
                                  "none"}) == "dots";
  spec.verify_rounds = static_cast<int>(node.integer(
      {"verify_rounds", "corrections of the density by what its dots show, at most", 0, 20, spec.verify_rounds}));
  spec.first_photons = static_cast<std::uint64_t>(
      node.count({"first_photons", "photons of the first step; 0: 50 for each cell", 0, 1'000'000'000'000, 0}));
  spec.photon_growth = node.number({"photon_growth", "factor from step to step while noise hides the error",
                                    Range::closed(1, 100), spec.photon_growth});
  return spec;
}

}  // namespace evenglow::design

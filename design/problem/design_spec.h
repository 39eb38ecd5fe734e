#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "design/problem/map_table.h"

namespace evenglow::design {

/// The wanted shape of the luminance.
struct TargetSpec {
  std::string kind = "uniform";  ///< uniform, center_weighted, map
  double corner = 0.8;           ///< of center_weighted: corner over center
  MapTable map;                  ///< of map: luminance over the display, any unit; 0: the cell does not count
};

/// Where the design begins.
struct StartSpec {
  std::string kind = "flat";  ///< flat (what the microstructure says), analytic, map
  MapTable map;               ///< of map: density over the plate
};

/// What is weighed against what.
struct GoalSpec {
  std::string kind = "even";    ///< even, max_efficiency, min_rms
  double rms = 0.02;            ///< of max_efficiency: not to be passed, noise-corrected
  double efficiency = 0.5;      ///< of min_rms: not to be fallen short of
  std::optional<double> color;  ///< of any kind: RMS distance of the cells' colors in (u', v') not to be passed
};

/// The updater `spline`.
struct SplineSpec {
  int nx = 4;
  int ny = 2;
  std::string method = "bobyqa";  ///< bobyqa, cobyla, sbplx
};

/// The updater `coarse_newton`.
struct CoarseNewtonSpec {
  int nx = 16;  ///< nodes along x
  int ny = 8;
};

/// The updater `gradient`.
struct GradientSpec {
  std::string method = "lbfgs";  ///< lbfgs, mma
  int evaluations = 20;          ///< of value and gradient, on the histories of a trace
};

/// The map `design` of the run file.
struct DesignSpec {
  TargetSpec target;
  MapTable mask;  ///< over the display: cells below 0.5 do not count; empty: all count
  StartSpec start;
  GoalSpec goal;
  std::string updater = "auto";
  double power = 1.0;        ///< exponent of the ratio updates
  int anderson_vectors = 3;  ///< differences that the acceleration may combine
  SplineSpec spline;
  CoarseNewtonSpec coarse_newton;
  GradientSpec gradient;
  double stop_rms = 0.01;  ///< noise-corrected RMS non-uniformity to reach
  int max_steps = 20;
  double density_min = 0.01;  ///< limits of the density of every cell
  double density_max = 0.8;
  MapTable least_map;                    ///< over the plate; empty: none
  MapTable largest_map;                  ///< over the plate; empty: none
  std::optional<double> neighbor_ratio;  ///< greatest ratio of the densities of neighboring cells
  std::string symmetry = "none";         ///< none, x, y, both
  std::optional<double> level;           ///< mean density over the plate; none: the knee of the efficiency
  std::uint64_t first_photons = 0;       ///< of the first step; 0: 50 a cell
  double photon_growth = 4.0;            ///< factor from step to step while the noise is larger than the error
  std::vector<double> pareto_levels;     ///< mean densities of `evenglow pareto`; empty: chosen
  bool verify_dots = false;              ///< the finished density is placed as dots and traced dot by dot
  int verify_rounds = 3;                 ///< corrections of the density by what the dots show, at most
};

/// Reads and checks the map; the files that it names are read.
DesignSpec read_design(const core::ConfigNode& design);

}  // namespace evenglow::design

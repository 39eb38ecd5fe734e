#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "design/problem/judgment.h"

namespace evenglow::design {

/// One placement of a design as dots, traced dot by dot.
struct DotsRound {
  std::size_t dots = 0;
  double area = 0.0;              ///< mm2 under dots
  StepRecord record;              ///< step: number of corrections before
  core::Estimate luminance;       ///< mean, cd/m2
  core::Estimate over_density{};  ///< mean luminance over that of the density model's judging trace
};

/// A finished design as real dots.
struct DotsJudgment {
  std::vector<DotsRound> rounds;
  std::size_t chosen = 0;  ///< of the rounds
  std::string stop_reason;
  FinalJudgment final;          ///< of the chosen dots, from random numbers that no round has seen
  core::Estimate over_density;  ///< mean luminance of that trace over the density model's
  core::CellField luminance;    ///< cd/m2, from that trace
  core::CellField luminance_se;
  core::CellField density;  ///< that the chosen dots were placed for
  EnergyAccount energy;
};

}  // namespace evenglow::design

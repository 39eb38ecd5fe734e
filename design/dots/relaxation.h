#pragma once

#include <stop_token>

#include "design/dots/coverage_map.h"
#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"
#include "design/dots/size_law.h"

namespace evenglow::design {

/// How the dots push each other apart.
struct RelaxationSettings {
  int free_steps = 30;    ///< in which dots may change their cell
  int restore_every = 5;  ///< of these the counts of the cells are set right
  int bound_steps = 6;    ///< after the counts of the cells were set right, in which they may not
  double reach = 2.0;     ///< of the push, in spacings
  double pace = 0.3;      ///< share of the push that one step goes
};

/// Turns scattered dots into blue noise: every dot is pushed by its neighbors within `reach` local spacings s, by
/// s (1 - r / (reach s))^2 along their distance r, and by its own image behind the borders of the free area; all dots
/// move at once, step by step (repelling dots as in Ide et al., J. Opt. Soc. Am. A 20, 248, 2003, with a short
/// force whose strength grows with s, so that an even pressure keeps a graded density). No dot leaves the free area,
/// and at the end every cell has its count within one dot (`restore_counts`). The result does not depend on the number
/// of threads. After a stop was asked for it and those below leave off.
void relax(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law, const RelaxationSettings& settings,
           int threads, DotStore& store, const std::stop_token& stop = {});

/// Pushes dots apart that are nearer than diameters and gap allow, until none are or `max_steps` are done; returns
/// whether none are. Diameters must be whole numbers of nm for the answer to hold after rounding of places to nm.
bool separate(const DotSpec& spec, const CoverageMap& map, int max_steps, int threads, DotStore& store,
              const std::stop_token& stop = {});

/// Gives the dots that still are too near to another one a free place within their cell, else takes them away; returns
/// how many were taken away.
std::size_t settle_conflicts(const DotSpec& spec, const CoverageMap& map, DotStore& store,
                             const std::stop_token& stop = {});

/// Least distance of the centers of two dots (mm), a little more than the process asks, for rounding to nm.
inline double least_distance(const DotSpec& spec, float diameter_a, float diameter_b) {
  constexpr double kRounding = 3e-6;
  return 0.5 * (core::footprint_span(spec.footprint, diameter_a) + core::footprint_span(spec.footprint, diameter_b)) +
         spec.gap + kRounding;
}

}  // namespace evenglow::design

#pragma once

#include <cstdint>
#include <vector>

#include "core/config/config_node.h"

namespace evenglow::tracer {

/// How the LEDs of a row differ from each other, drawn once: a trace or a design sees one realization.
struct LedTolerances {
  std::vector<double> fluxes;   ///< lm, of each LED in order along the edge; empty: all alike
  std::vector<double> offsets;  ///< mm along the edge, from the LED's place; empty: none
  std::vector<double> heights;  ///< mm across the edge, towards +z, from the middle of the plate; empty: none
};

/// How they are to be drawn.
struct LedToleranceKeys {
  std::vector<double> fluxes;    ///< lm, as given; empty: none given
  double flux_spread = 0.0;      ///< standard deviation, relative to the LED's flux
  double position_spread = 0.0;  ///< mm, standard deviation along the edge
  std::uint64_t seed = 1;
  std::vector<int> off;         ///< LEDs that stay dark, from 0
  std::vector<double> factors;  ///< on the flux of each LED, > 0; empty: none
  std::vector<double> offsets;  ///< mm along the edge, of each LED, besides the spread; empty: none
  std::vector<double> heights;  ///< mm towards +z, of each LED; empty: none
};

/// Spreads are normal and cut at this many standard deviations.
inline constexpr double kToleranceCut = 3.0;

/// Reads the keys of a row of `count` LEDs. Faults are noted at the node.
///
/// | key | meaning | default |
/// | --- | --- | --- |
/// | fluxes_lm | flux of each LED, in order along the edge, instead of flux_lm | |
/// | flux_spread | standard deviation of the fluxes, relative; normal, cut at 3 of them | 0 |
/// | position_spread_mm | standard deviation of the places along the edge; normal, cut at 3 of them | 0 |
/// | tolerance_seed | draws other fluxes and places | 1 |
/// | off | LEDs that stay dark, counted from 1 along the edge | none |
/// | flux_factors | factor on the flux of each LED, whatever else says how bright it is | 1 |
/// | offsets_mm | shift of each LED along the edge, besides its drawn one | 0 |
/// | height_offsets_mm | shift of each LED across the edge, towards +z | 0 |
LedToleranceKeys read_led_tolerances(const core::ConfigNode& node, int count);

/// The realization for `count` LEDs of `flux` (lm). LED i has the same draws whatever the count.
LedTolerances draw_tolerances(const LedToleranceKeys& keys, int count, double flux);

}  // namespace evenglow::tracer

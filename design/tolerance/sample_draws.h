#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "design/tolerance/dot_change.h"
#include "design/tolerance/tolerance_spec.h"

namespace evenglow::design {

/// The design about which the samples vary.
struct Nominal {
  std::vector<double> values;  ///< of each variation: the key's value, 1 for a flux, else 0
  std::vector<int> leds;       ///< of each source: its LEDs, 0 if it is no row of them
};

/// What one sample drew: of each variation its number, or one for each LED of its rows; none where each dot or place
/// has its own. Depends on seed, variation and sample alone: a variation more at the end of the list changes none of
/// the others.
using SampleDraws = std::vector<std::vector<double>>;

SampleDraws draw_sample(const ToleranceSpec& spec, const Nominal& nominal, int sample);

/// Every number at its least or greatest value; of neighboring LEDs that move along the edge, one at each, so that they
/// come as near as they may. For checks before the first photon.
SampleDraws extreme_sample(const ToleranceSpec& spec, const Nominal& nominal, bool greatest);

/// How the dots of a sample miss the drawing, and the density that they make. `growth` (mm): that of the regions alone.
struct SampleDots {
  core::CellField density;
  std::vector<core::CellField> growth;  ///< of each variation; without cells but for dot_region
};
SampleDots draw_dots(const ToleranceSpec& spec, const SampleDraws& draws, int sample, const core::CellField& density,
                     const DotModel& model);

/// Does any variation change the dots?
bool varies_dots(const ToleranceSpec& spec);

/// The numbers by which a sample is told and against which its figures are held: of a list of LEDs their mean and
/// standard deviation, of a region's growth (um) its mean and standard deviation over the plate; none for what each dot
/// has for itself.
std::vector<std::string> parameter_names(const ToleranceSpec& spec);
std::vector<double> parameters_of(const ToleranceSpec& spec, const SampleDraws& draws,
                                  const std::vector<core::CellField>& growth);

}  // namespace evenglow::design

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "design/problem/map_table.h"
#include "design/tolerance/distribution.h"
#include "tracer/scene/backlight_spec.h"

namespace evenglow::design {

/// What varies. Lengths and angles of the distribution in the unit that the name ends in; a flux is a factor.
enum class VariationKind {
  dot_growth,  ///< um, every dot of a sample has a diameter greater by it
  dot_size,    ///< um, each dot by its own
  dot_place,   ///< um, along x and along y, each dot by its own
  dot_region,  ///< um, growth that changes slowly over the plate
  led_flux,    ///< factor, each LED its own
  led_along,   ///< mm along the edge, each LED its own
  led_height,  ///< mm across the edge, each LED its own
  film_angle,  ///< deg, added to the film's axis
  key          ///< any scalar key, in its unit
};

struct Variation {
  VariationKind kind = VariationKind::key;
  std::string name;  ///< as the run file says: `dot_growth_um`
  Distribution distribution{};
  double length = 0.0;    ///< mm, of dot_region: distance at which its correlation has fallen to exp(-1/2)
  int film = 0;           ///< of film_angle, from 0
  int source = -1;        ///< of the LEDs, from 0; -1: all rows
  std::string key{};      ///< of key: its path
  bool relative = false;  ///< of key: the spread is a share of its value
};

/// The name of a variation with what it is about: `led_flux of sources[1]`.
std::string title_of(const Variation& variation);

/// A bound on a figure; what breaks it is not fit for sale.
struct Limit {
  std::string figure;  ///< as in result.json
  std::optional<double> min;
  std::optional<double> max;
};

/// The map `tolerance` of the run file.
struct ToleranceSpec {
  int samples = 200;
  std::uint64_t seed = 1;           ///< of what varies, not of the photons
  std::uint64_t photons = 500'000;  ///< of each sample
  std::uint64_t reference = 0;      ///< photons of the nominal design; 0: as trace.photons
  bool common_numbers = false;      ///< every sample is traced with the same random numbers
  MapTable density{};               ///< of an earlier result; empty: that of the microstructure
  std::vector<Limit> limits{};
  std::vector<Variation> variations{};  ///< none: the file asks for no tolerance run
};

/// Reads the map below the top of the run file. `backlight` serves to check what the variations name; faults are noted.
ToleranceSpec read_tolerance(const core::ConfigNode& root, const tracer::BacklightSpec& backlight);

}  // namespace evenglow::design

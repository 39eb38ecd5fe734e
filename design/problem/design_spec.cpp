#include "design/problem/design_spec.h"

#include <fmt/core.h>

namespace evenglow::design {

using core::Range;

DesignSpec read_design(const core::ConfigNode& node) {
  DesignSpec spec;
  spec.target = node.choice({"target", "wanted shape of the luminance", {"uniform"}, "uniform"});
  spec.updater = node.choice(
      {"updater",
       "how the next density is proposed: the ratio update on a response with its noise taken out, or the plain one",
       {"ratio_noise_aware", "ratio"},
       spec.updater});
  spec.power = node.number({"power", "exponent of target over luminance", {0, 2, true, false}, spec.power});
  spec.stop_rms =
      node.number({"stop_rms", "noise-corrected RMS non-uniformity to reach", {0, 1, true, false}, spec.stop_rms});
  spec.max_steps =
      static_cast<int>(node.integer({"max_steps", "largest number of steps after the start", 0, 1000, spec.max_steps}));
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
  spec.level = node.optional_number(
      {"level",
       "mean density over the plate; left out: as high as the limits allow, which is the most efficient",
       {0, 1, true, false}});
  if (spec.level && (*spec.level < spec.density_min || *spec.level > spec.density_max)) {
    node.fault_at("level", fmt::format("must lie between the limits of the density, [{}, {}], got {}", spec.density_min,
                                       spec.density_max, *spec.level));
  }
  spec.first_photons = static_cast<std::uint64_t>(
      node.count({"first_photons", "photons of the first step; 0: 50 for each cell", 0, 1'000'000'000'000, 0}));
  spec.photon_growth = node.number({"photon_growth", "factor from step to step while noise hides the error",
                                    Range::closed(1, 100), spec.photon_growth});
  return spec;
}

}  // namespace evenglow::design

#pragma once

#include <string>

#include "tests/support/two_paths.h"

namespace evenglow::tests {

/// A backlight in YAML's flow style, as `scene_of` takes it.
struct NamedBacklight {
  std::string name, yaml;
};

/// Fails the test unless both traces agree: each entry of the energy account and the mean luminance by |z| with the
/// standard errors of both, false alarm 0.27 % (3 sigma) for all of them together; the cells' luminance by chi-square
/// per cell within 1 +- `chi_tolerance`, where more than 1000 cells have light; the number of events. Prints what it
/// found.
void expect_paths_agree(const std::string& name, const tracer::Scene& scene, const TwoPaths& paths,
                        const TraceSetup& setup, double chi_tolerance);

}  // namespace evenglow::tests

#pragma once

#include <string>
#include <vector>

#include "design/dots/dot_spec.h"
#include "design/dots/dot_store.h"
#include "design/dots/sample_windows.h"

namespace evenglow::design {

/// A periodic part above the pattern.
struct Grating {
  std::string name;  ///< for the user: "panel", "films[2] (bef)"
  GratingSpec lines;
  bool is_panel = false;
};

/// A beat of the pattern with a harmonic of a grating.
struct Beat {
  std::string grating;
  int order_x = 0, order_y = 0;  ///< harmonic of the grating
  double period = 0.0;           ///< mm, of the beat
  double pattern_period = 0.0;   ///< mm, of the part of the pattern that makes it
  double amplitude = 0.0;  ///< of that part, relative to the mean (1: all dots in step), shape of the dots counted
  double contrast = 0.0;   ///< of the beat: half of its peak-to-peak swing over the mean, nothing blurred
  double seen = 0.0;       ///< contrast times the eye's sensitivity over its best one
  bool visible = false;    ///< `seen` is above the threshold
};

/// What is taken for granted; docs/dots.md tells why.
struct MoireSettings {
  double viewing_distance = 350.0;  ///< mm
  double threshold = 0.005;         ///< contrast that the eye just sees at its best
  double aperture = 0.7;            ///< open share of a pixel along x and along y
  double prism_amplitude = 0.5;     ///< of the first harmonic of a prism film; order n: over n
  double window = 8.0;              ///< mm, side of the squares in which the pattern must be in step
};

/// Sensitivity of the eye at cycles per degree, over its greatest (Mannos & Sakrison, IEEE Trans. Inf. Theory 20,
/// 1974).
double eye_sensitivity(double cycles_per_degree);

/// Strongest beat with each harmonic (orders up to 2) of each grating, of periods from 0.5 mm, from parts of the
/// pattern that are in step over whole squares of `window`: the spectrum there stands so far above what dots out of
/// step give that chance makes less than one in 1e9. Strongest first. Blue noise has no such part.
std::vector<Beat> find_beats(const DotStore& dots, const FreeArea& free, const std::vector<Grating>& gratings,
                             const MoireSettings& settings, int threads);

}  // namespace evenglow::design

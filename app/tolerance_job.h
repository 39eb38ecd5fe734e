#pragma once

#include <filesystem>
#include <vector>

#include "app/run_file.h"
#include "design/tolerance/sample_draws.h"

/// From a run file with the map `tolerance` to the backlights of its samples.
namespace evenglow::app {

/// What all samples have in common.
struct ToleranceJob {
  std::filesystem::path file;
  Options options;
  Run nominal;  ///< with the density that is made
  design::Nominal values;
  core::CellField density;  ///< that is made; one cell of 0 without microstructure
  design::DotModel dots;
  std::vector<std::vector<double>> factors, along, height;  ///< what the file says of the LEDs of each source, or none
};

/// Reads the run file and checks that every sample can be made, as far as the ends of the distributions tell. Throws
/// ConfigError.
ToleranceJob read_tolerance_job(const Options& options);

/// A backlight as production makes it.
struct ToleranceSample {
  Run run;
  std::vector<double> parameters;  ///< as `parameter_names`
};

/// Sample `number`, from 1. Throws ConfigError where what was drawn is no backlight.
ToleranceSample make_sample(const ToleranceJob& job, int number);

/// Sets the density that a run begins with.
void set_density(Run& run, const core::CellField& density);

}  // namespace evenglow::app

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/options.h"
#include "core/config/config_node.h"
#include "design/dots/dot_spec.h"
#include "design/engine/outer_design.h"
#include "design/problem/design_spec.h"
#include "design/tolerance/tolerance_spec.h"
#include "tracer/scene/backlight_spec.h"
#include "tracer/transport/tracer.h"

namespace evenglow::app {

/// One run, read and checked.
struct Run {
  std::filesystem::path file;
  std::string variant;  ///< empty: the file itself
  std::string title;
  tracer::BacklightSpec backlight;
  tracer::TraceSpec trace;
  design::DesignSpec design;
  design::OuterSpec outer;  ///< of `evenglow optimize`; no variables: the file names none
  design::DotSpec dots;
  design::ToleranceSpec tolerance;  ///< of `evenglow tolerance`; no variations: the file names none
  std::vector<std::string> output;  ///< formats
  std::string file_text;
  std::vector<std::string> overrides;             ///< key=value
  std::vector<std::filesystem::path> data_files;  ///< that the run file names (film tables)
};

/// What a run is read for: a design needs a microstructure whose density it can change.
enum class Purpose { kTrace, kDesign };

/// --set, --seed and --photons as changes of the run file. Throws ConfigError: a --set without a key or a value.
std::vector<core::ConfigDocument::Override> option_overrides(const Options& options);

/// Reads all keys of the document; its faults are noted there, for `finish()`.
Run read_keys(const core::ConfigDocument& document, Purpose purpose = Purpose::kTrace);

/// Reads the run that the file describes, with the options laid over it; `variants` and `sweep` are left aside. Throws
/// ConfigError with all faults.
Run read_run(const std::filesystem::path& file, const Options& options, Purpose purpose = Purpose::kTrace);

/// Reads each variant of the file (the file itself if it has none). Faults of all variants are thrown together.
std::vector<Run> read_variants(const std::filesystem::path& file, const Options& options,
                               Purpose purpose = Purpose::kTrace);

/// One of the runs that a file stands for in a batch: a variant at a point of the sweep.
struct RunPoint {
  std::string name;  ///< `lpp`, `p2_haze-0.9`, `lpp_p2_haze-0.9`; empty: the file itself
  std::vector<core::ConfigDocument::Override> changes;
};

/// Each variant of the file at each point of its sweep; one point without changes if it has neither. Faults of
/// `variants` and `sweep` themselves show when a point is read.
std::vector<RunPoint> run_points(const std::filesystem::path& file);

/// Reads the run of a point; `last` changes it once more, after the options. Throws ConfigError with all faults.
Run read_point(const std::filesystem::path& file, const RunPoint& point, const Options& options,
               Purpose purpose = Purpose::kTrace, const std::vector<core::ConfigDocument::Override>& last = {});

}  // namespace evenglow::app

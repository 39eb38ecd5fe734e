#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/options.h"
#include "core/config/config_node.h"
#include "design/problem/design_spec.h"
#include "tracer/scene/backlight_spec.h"
#include "tracer/transport/tracer.h"

namespace evenglow::app {

/// One run, read and checked.
struct Run {
  std::string variant;  ///< empty: the file itself
  std::string title;
  tracer::BacklightSpec backlight;
  tracer::TraceSpec trace;
  design::DesignSpec design;
  std::vector<std::string> output;  ///< formats
  std::string file_text;
  std::vector<std::string> overrides;             ///< key=value
  std::vector<std::filesystem::path> data_files;  ///< that the run file names (film tables)
};

/// What a run is read for: a design needs a microstructure whose density it can change.
enum class Purpose { kTrace, kDesign };

/// --set, --seed and --photons as changes of the run file. Throws ConfigError: a --set without a key or a value.
std::vector<core::ConfigDocument::Override> option_overrides(const Options& options);

/// Reads the run that the file describes, with the options laid over it; `variants` are left aside. Throws
/// ConfigError with all faults.
Run read_run(const std::filesystem::path& file, const Options& options, Purpose purpose = Purpose::kTrace);

/// Reads each variant of the file (the file itself if it has none). Faults of all variants are thrown together.
std::vector<Run> read_variants(const std::filesystem::path& file, const Options& options,
                               Purpose purpose = Purpose::kTrace);

}  // namespace evenglow::app

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "core/math/cell_field.h"
#include "design/dots/dot_spec.h"
#include "design/dots/moire.h"

namespace evenglow::app {

struct Run;

/// All that `evenglow dots` works on.
struct DotsInput {
  std::string title;
  design::DotSpec spec;
  design::RectangleZone plate;
  std::optional<core::CellField> coverage;  ///< share of each cell under footprints; none: a pattern without a design
  std::vector<design::Grating> gratings;
  std::string run_file;              ///< path; empty: none
  std::vector<std::string> remarks;  ///< for the user, one line each
};

/// Changes of the map `dots` by options of the command line.
using DotsOverrides = std::vector<core::ConfigDocument::Override>;

/// The design in a result directory: its density, and plate, shape, films and `dots` of its run file, which
/// `result.json` names and its checksum proves, or which `run_file` gives. Throws ConfigError in one line for each
/// fault.
DotsInput read_designed(const std::filesystem::path& directory, const std::filesystem::path& run_file,
                        const DotsOverrides& overrides);

/// The plate, films and `dots` of a run (`file`: the path of its run file), without a density.
DotsInput dots_input_of(const Run& run, const std::string& file);

/// For a pattern that exists: as the run file says if there is one, else defaults on a plate of unknown size.
DotsInput read_surroundings(const std::filesystem::path& run_file, const DotsOverrides& overrides);

}  // namespace evenglow::app

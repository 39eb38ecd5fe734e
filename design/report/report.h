#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/estimate.h"
#include "design/problem/dots_judgment.h"
#include "design/problem/judgment.h"
#include "design/problem/metrology.h"

/// The result of a run: facts, curves and maps with their units. Knows no file format; the writers do.
namespace evenglow::design {

struct Timing {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double photons_per_cpu_s = 0.0;
};

/// A film of the stack, for the reader.
struct FilmEntry {
  std::string kind;
  double axis_deg = 0.0;             ///< 0 where the kind has none
  double gap_mm = 0.0;               ///< air below it
  std::vector<std::string> remarks;  ///< what its data needed, one sentence each
};

/// How a remark of film `index` stands among the notes.
std::string film_note(std::size_t index, const FilmEntry& film, const std::string& remark);

/// A finished (or interrupted) `simulate` or `design` run of one backlight.
struct Report {
  std::string version;
  std::string build_id;  ///< of the program (core/base/build_id.h)
  std::string title;
  std::string variant;                 ///< name within a comparison; empty for a single run
  std::string command;                 ///< the command line that repeats the run, paths as given by the user
  std::string run_file_text;           ///< as read
  std::string run_file_sha256;         ///< lower-case hex
  std::vector<std::string> overrides;  ///< `key=value` of --set and of the variant
  std::uint64_t seed = 0;
  int threads = 1;
  int ranks = 1;
  std::string stop_reason;          ///< one sentence; of `simulate`: "single trace"
  std::string processor;            ///< model of the CPU; empty: unknown
  std::string luminance_estimator;  ///< one sentence: how the luminance was estimated
  std::vector<StepRecord> steps;    ///< of `simulate`: one
  FinalJudgment final;
  core::CellField start_luminance;  ///< cd/m2, of step 0
  core::CellField luminance;        ///< cd/m2, active area, from the final trace
  core::CellField luminance_se;     ///< cd/m2
  core::CellField target;           ///< wanted luminance, mean 1 over the cells that count (others 0); empty: uniform
  core::CellField density;          ///< 0 to 1, over the plate
  double density_min = 0.0;         ///< limits of the design
  double density_max = 1.0;
  EnergyAccount energy;
  std::optional<AngularLuminance> angular;
  std::vector<SpotLuminance> angular_spots;
  std::optional<ColorJudgment> color;
  std::vector<FilmEntry> films;      ///< from the plate upwards
  std::vector<HotSpots> hot_spots;   ///< of each row of LEDs
  std::optional<DotsJudgment> dots;  ///< of the design as dots, if it was verified so
  std::string section_svg;           ///< the stack in section with ways of photons, an SVG element; may be empty
  std::vector<std::string> notes;    ///< remarks for the reader (limits that bind, assumptions of film data)
  Timing timing;
};

/// Ratios of one variant to the first one, for equal LED flux.
struct VariantRatio {
  std::string name;  ///< "dbef/lpp"
  core::Estimate luminance;
  core::Estimate flux;  ///< flux out of the top
  core::Estimate efficiency;
};

/// Designs side by side.
struct Comparison {
  std::string title;
  std::string command;
  std::vector<Report> variants;  ///< the first is the base of the ratios
  std::vector<VariantRatio> ratios;
};

/// Ratios of each variant over the first (flux and luminance per lumen of LED flux, `energy.emitted_lm`).
/// Errors to first order, the traces of two variants taken as independent. A base of zero gives "not a number".
/// Variants without a name, or with one already taken, get one of their own. `variants` must not be empty.
Comparison compare_reports(std::string title, std::string command, std::vector<Report> variants);

/// Writes the files of one format into an existing directory.
class ReportWriter {
 public:
  virtual ~ReportWriter() = default;
  /// The files of a single run.
  virtual void write(const Report& report, const std::filesystem::path& directory) const = 0;
  /// The files of a comparison (in addition to those of each variant, which stand in directories of their own).
  virtual void write(const Comparison& comparison, const std::filesystem::path& directory) const = 0;
};

}  // namespace evenglow::design

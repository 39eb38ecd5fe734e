#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "design/report/curve_plot.h"

/// A study of several designs: a front, a bench of methods, an outer search. One table, some curves, some maps.
namespace evenglow::design {

struct StudyMap {
  std::string title;
  std::string caption;
  core::CellField field;
};

struct Study {
  std::string title;
  std::string version;
  std::string command;   ///< repeats it
  std::string run_file;  ///< as read
  std::string lead;      ///< a paragraph: what is shown, and how it was measured
  std::vector<std::string> notes;
  std::vector<std::string> columns;            ///< of the table, for people
  std::vector<std::vector<std::string>> rows;  ///< as many entries as columns
  std::vector<CurvePlot> plots;
  std::vector<StudyMap> densities;
};

/// A self-contained page: lead, curves, table, densities, command and run file.
std::string study_html(const Study& study);

/// The plots, one below the other, as a picture. Throws core::Error if it cannot be written.
void write_study_png(const Study& study, const std::filesystem::path& path);

/// The table as plain text, columns aligned.
std::string study_text(const Study& study);

}  // namespace evenglow::design

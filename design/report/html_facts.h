#pragma once

#include <string>
#include <vector>

#include "design/report/report.h"

/// Figures in words and tables. Plain text comes in, escaped HTML goes out.
namespace evenglow::design {

/// The four headline numbers of a run, each with its definition.
std::string headline_cards(const Report& report);
/// The ratios of a comparison: a card for each gain in luminance, a table of all, definitions.
std::string ratio_cards(const Comparison& comparison);
/// The final figures, a column for each report.
std::string final_table(const std::vector<const Report*>& reports);
/// A row for each step.
std::string step_table(const Report& report);
/// List of the remarks but those on films, which stand in their table; empty if there are none.
std::string note_list(const Report& report);
/// Command, version, seed, checksum and machine.
std::string repeat_table(const Report& report);
/// The run file as read, folded.
std::string run_file_fold(const Report& report);
/// Rows of name and text (not yet escaped).
std::string fact_table(const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace evenglow::design

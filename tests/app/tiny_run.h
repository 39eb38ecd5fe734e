#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"

/// A backlight of 20 mm x 10 mm that is designed in a second, and the program on it.
namespace evenglow::tests {

inline constexpr const char* kTinyRun = R"(evenglow: 1
title: tiny
backlight:
  light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}
  microstructure: {cells: [8, 4]}
  sources: [{kind: led_row, count: 2, pitch_mm: 5}]
  reflectors: {bottom: {kind: white}, right: {kind: white}}
  films: [{kind: diffuser, transmittance: 0.88, reflectance: 0.10}, {kind: dbef}]
variants:
  lpp: {"backlight.films[1]": {kind: lpp}}
  dbef: {}
trace: {photons: 2e4, seed: 7, batches: 20}
design: {stop_rms: 0.001, max_steps: 3}
)";

inline std::vector<std::string> words_of(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

/// `evenglow` with these arguments in `folder`.
inline ProgramResult evenglow(const std::vector<std::string>& arguments, const std::filesystem::path& folder = {}) {
  return run_program(words_of(EVENGLOW_PROGRAM, arguments), folder);
}

inline nlohmann::ordered_json json_of(const std::filesystem::path& file) {
  return nlohmann::ordered_json::parse(file_text(file));
}

/// A result without what may differ from run to run.
inline std::string lasting_part(const std::filesystem::path& result_file) {
  nlohmann::ordered_json result = json_of(result_file);
  result.erase("timing");
  result.erase("threads");
  result.erase("ranks");
  return result.dump(1);
}

/// `design` of tiny.yaml with these settings, and what comes on top.
inline std::vector<std::string> design_words(const std::string& out, const std::vector<std::string>& settings,
                                             const std::vector<std::string>& more) {
  std::vector<std::string> words = {"design", "tiny.yaml", "-o", out};
  words.insert(words.end(), settings.begin(), settings.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The steps of the newest checkpoint of a result directory, of itself or of the step before.
inline std::size_t saved_steps(const std::filesystem::path& directory) {
  for (const char* name : {"checkpoint.json", "checkpoint.previous.json"}) {
    const auto state = nlohmann::json::parse(file_text(directory / name), nullptr, false);
    if (!state.is_discarded()) return state["steps"].size();
  }
  return 0;
}

}  // namespace evenglow::tests

#pragma once

#include <cstddef>
#include <string>

#include "core/config/text_file.h"

/// What a run file may hold, and the words for what is more. Inner part of core/config.
namespace evenglow::core {

inline constexpr int kMaxConfigDepth = 64;
inline constexpr std::size_t kMaxConfigValues = 200000;  ///< aliases followed
/// Faults of form that one text may collect before its reading ends.
inline constexpr std::size_t kMaxYamlFaults = 1000;
/// Line breaks and punctuation of a text; the most values that are allowed need about as many.
inline constexpr std::size_t kMaxPunctuation = 1000000;

inline constexpr const char* kTooDeep = "must not nest deeper than 64";
inline constexpr const char* kTooManyValues = "must not hold more than 200000 values, aliases followed";
inline constexpr const char* kTooMuchText = "must not hold more than 8 MiB of text, aliases followed";

/// What would cost the YAML parser, which may look ahead to the end of the text, too much time and memory, told before
/// it sees the text; empty: nothing.
std::string trouble_for_parser(const std::string& text);

}  // namespace evenglow::core

#pragma once

#include <numbers>

/// Factors between the units of the files and ours. Inside are mm, rad, lm, nm; luminance leaves as cd/m2.
namespace evenglow::core {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kMmPerM = 1000.0;
inline constexpr double kMmPerUm = 1e-3;
/// lm/(sr mm2) to cd/m2 (= lm/(sr m2)).
inline constexpr double kCandelaPerM2 = kMmPerM * kMmPerM;

}  // namespace evenglow::core

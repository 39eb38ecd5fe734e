#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace evenglow::tracer {

/// Photons that are stepped together. The same for every instruction set: narrower registers take a group in parts, so
/// that the order of all that is added up, and with it every bit, is the same.
inline constexpr std::size_t kLanes = 16;

/// Why a lane needs more than the kernel does. The light of kWall and kBacking is counted in the frame
/// of the wall (`PlanarWall`), all other light in the meridian frame (`MeridianLight`).
enum class LaneExit : std::uint32_t {
  kNone,            ///< in the plate: to be stepped on
  kEmpty,           ///< no photon
  kAbsorbed,        ///< by `part`
  kStuck,           ///< more events than any real path has
  kEscaped,         ///< through the top, above which there is nothing
  kTop,             ///< in air at the top
  kBottom,          ///< in air at the bottom
  kReflector,       ///< in air at the reflector below, upward
  kWallInside,      ///< inside at the wall `side`, which is no smooth face: nothing has happened there yet
  kWall,            ///< in air at the wall `side`
  kBacking,         ///< in air at the reflector behind the wall `side`, coming from it
  kPattern,         ///< inside at the pattern, which it meets: nothing has happened there yet
  kPatternOutside,  ///< in air at the pattern, which it meets from outside: nothing has happened there yet
  kArrives,         ///< natural light in air at the smooth wall `side`, to be let in by `enter_plate`
};

using LaneNumbers = std::array<float, kLanes>;
using LaneWords = std::array<std::uint32_t, kLanes>;

/// The photons of a group: what `PlanarPlateState`, `PlanarProgress` and `MeridianLight` hold of one, for each lane, in
/// single precision: 6e-8 of a length or an angle is far below what Monte Carlo can see. Random numbers of its own.
struct alignas(64) PlateLanes {
  LaneNumbers x{}, y{}, z{};               ///< mm
  LaneNumbers kx{}, ky{}, kz{};            ///< direction in the medium, unit
  LaneNumbers I{}, Q{}, U{}, V{};          ///< I is the unit of the others, not a power
  LaneNumbers depth{};                     ///< optical depth left until bulk absorption
  LaneNumbers missed{}, fate{}, events{};  ///< of `PlanarProgress`
  std::array<LaneWords, 4> random{};       ///< state of xoshiro128+
  LaneWords exit{};                        ///< LaneExit
  LaneNumbers part{};                      ///< that absorbs (kAbsorbed)
  LaneNumbers side{};                      ///< wall: 0 to 3
};

inline void copy_lane(const PlateLanes& from, std::size_t i, PlateLanes& to, std::size_t j) {
  constexpr LaneNumbers PlateLanes::*kNumbers[] = {
      &PlateLanes::x,    &PlateLanes::y,      &PlateLanes::z,     &PlateLanes::kx,
      &PlateLanes::ky,   &PlateLanes::kz,     &PlateLanes::I,     &PlateLanes::Q,
      &PlateLanes::U,    &PlateLanes::V,      &PlateLanes::depth, &PlateLanes::missed,
      &PlateLanes::fate, &PlateLanes::events, &PlateLanes::part,  &PlateLanes::side};
  for (const auto numbers : kNumbers) (to.*numbers)[j] = (from.*numbers)[i];
  for (std::size_t word = 0; word < 4; ++word) to.random[word][j] = from.random[word][i];
  to.exit[j] = from.exit[i];
}

}  // namespace evenglow::tracer

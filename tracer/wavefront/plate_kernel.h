#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tracer/wavefront/plate_constants.h"
#include "tracer/wavefront/plate_lanes.h"

/// The one door to Highway: photons in the plate, 4 to 16 at a time, by the widest instruction set of the machine.
namespace evenglow::tracer {

/// One step of every lane of the groups whose exit is kNone: all total reflections up to a wall, a meeting with the
/// pattern, or absorption, or one flight of light that the faces let out; and what happens at its end
/// (`PlanarPlateWalk` takes the same steps, with the same formulas). What a lane does depends on its own state alone.
/// Only sums, products, quotients and roots in one order, none of them contracted: same bits by any instruction set.
void step_plate(const PlateConstants& plate, PlateLanes* groups, std::size_t count);

/// Lets in, or reflects (kWall), the lanes whose exit is kArrives.
void enter_plate(const PlateConstants& plate, PlateLanes& group);

/// The instruction sets that this program has code for and this machine knows, widest first: bits for
/// `force_instruction_set`.
std::vector<std::int64_t> instruction_sets();
/// Its usual name, as AVX2.
std::string instruction_set_name(std::int64_t set);
/// For tests: only this one is used from now on, in all threads; 0: the widest again.
void force_instruction_set(std::int64_t set);

}  // namespace evenglow::tracer

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/dots/dot.h"

namespace evenglow::core {

/// The dots of a drawing and what else it holds.
struct DxfDots {
  DotPattern dots;
  std::size_t ignored = 0;  ///< entities that are neither circles nor references to blocks of circles
};

/// Reads the circles of an ASCII DXF file (R12 or later): `CIRCLE` entities, and `INSERT`s of blocks that hold circles
/// (moved, turned, scaled alike in x and y, no arrays of them, no blocks within blocks). Lengths are those of the
/// header's $INSUNITS (inch, mm, cm, m, um), mm without. Source: Autodesk, DXF Reference (group codes). Throws
/// ConfigError, with the line: no ASCII DXF, larger than 512 MiB, a value that is no number, a circle without a
/// radius, an unknown block, another unit, more than 20 million circles, none at all.
DxfDots read_dot_dxf(const std::filesystem::path& file);
DxfDots parse_dot_dxf(std::string_view text, const std::string& name);

}  // namespace evenglow::core

#pragma once

#include <cstdint>

#include "core/dots/dot.h"
#include "design/dots/dot_spec.h"

namespace evenglow::design {

/// The dots as the maker's process leaves them: every diameter grows by the bias, diameters and places scatter normally
/// about their drawing. A dot's numbers depend on seed and index. Dots that shrink to nothing are left out.
core::DotPattern processed(const core::DotPattern& dots, const ProcessSpread& process, std::uint64_t seed, int threads);

}  // namespace evenglow::design

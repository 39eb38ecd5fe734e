#pragma once

#include <optional>

#include "tracer/sources/source.h"

namespace evenglow::tracer {

/// Where along their side (mm) windows of the two sources lie on each other; none if they do not, or if the sources
/// stand at different sides. Windows of a source are taken to be ordered along the side.
std::optional<double> overlap(const Source& a, const Source& b);

}  // namespace evenglow::tracer

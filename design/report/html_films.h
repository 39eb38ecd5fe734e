#pragma once

#include <string>

#include "design/report/report.h"

namespace evenglow::design {

/// The stack from the plate upwards: name (as in the energy account), kind, axis, gap, remarks. Empty without films.
std::string film_table(const Report& report);

}  // namespace evenglow::design

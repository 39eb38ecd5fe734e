#pragma once

#include <string>

#include "design/report/energy_rows.h"

namespace evenglow::design {

/// The energy account of one report as a flow (Sankey) diagram, an inline SVG element: from the emitted flux on the
/// left through "sides" (all but the top) and "absorbed" to each destination with its percent and error on the right.
/// Widths are to scale; what has no share is left out. Colors are those of the table's rows.
std::string energy_flow(const EnergyRows& account, std::size_t report, double emitted_lm);

}  // namespace evenglow::design

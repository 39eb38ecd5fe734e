#pragma once

#include <string>

#include "design/report/page_data.h"
#include "design/report/report.h"

namespace evenglow::design {

/// The design as real dots beside its density: figures, rounds, maps. Empty without them. `id` as of `run_maps`.
std::string dots_section(const Report& report, const std::string& id, PageData& data);

}  // namespace evenglow::design

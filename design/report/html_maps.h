#pragma once

#include <string>
#include <vector>

#include "design/report/page_data.h"
#include "design/report/report.h"

/// The maps of a page, each group with its switches and the sections through the pointed cell.
namespace evenglow::design {

/// Luminance (of a design also at the start), density, standard error of one run; `id` is the end of the names of its
/// groups, one of its own for each run of a page.
std::string run_maps(const Report& report, const std::string& id, PageData& data);

/// Luminance of all variants on one scale.
std::string variant_luminance_maps(const std::vector<const Report*>& reports, PageData& data);
/// Density of all variants on one scale.
std::string variant_density_maps(const std::vector<const Report*>& reports, PageData& data);
/// Each variant against the first: ratio and difference of the luminance, difference of the density. Empty if there is
/// but one variant; variants on other cells than the first are named instead.
std::string relation_maps(const std::vector<const Report*>& reports, PageData& data);

}  // namespace evenglow::design

#pragma once

#include <string>
#include <vector>

#include "design/report/named_maps.h"

namespace evenglow::design {

/// VTK ImageData (XML, 64-bit floats in base64), mm, for ParaView: `maps.vti` with all maps as cell data on the cells
/// of the display. The density, whose cells are the plate's, stands there as the value of the nearest cell; where the
/// two grids differ, `density.vti` has it as it is. Of a comparison: the ratios and differences, if there are any.
class VtiWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

/// One file; maps on other cells than `grid` as values of the nearest cells.
std::string vti_text(const std::vector<NamedMap>& maps, const core::CellGrid& grid);

}  // namespace evenglow::design

#pragma once

#include <string>

#include "design/report/named_maps.h"

namespace evenglow::design {

/// `maps.h5`: all maps with their axes in HDF5 (docs/results.md tells the layout). Of a comparison: the ratios and
/// differences, if there are any.
class Hdf5MapWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

/// The bytes of such a file.
std::string hdf5_maps(const Report& report);
std::string hdf5_maps(const Comparison& comparison);

}  // namespace evenglow::design

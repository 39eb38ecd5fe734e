#pragma once

#include <string>

#include "design/report/report.h"

namespace evenglow::design {

/// Tables for other programs. Numbers read back as they were; the first line of a matrix or of the angular table is a
/// comment (#) with units. Of a single run: convergence.csv, luminance.csv, luminance_se.csv, density.csv (rows = y
/// from the front, columns = x from the left; a field without values is left out) and, if there is an angular receiver,
/// angular.csv; then the tables of csv_metrology.h. Of a comparison: compare.csv, a row for each variant with its
/// ratios to the first.
class CsvWriter final : public ReportWriter {
 public:
  void write(const Report& report, const std::filesystem::path& directory) const override;
  void write(const Comparison& comparison, const std::filesystem::path& directory) const override;
};

std::string convergence_csv(const Report& report);
/// `quantity` with its unit, as in "luminance (cd/m2)".
std::string matrix_csv(const core::CellField& field, const std::string& quantity);
std::string angular_csv(const AngularLuminance& angular);
std::string comparison_csv(const Comparison& comparison);

}  // namespace evenglow::design

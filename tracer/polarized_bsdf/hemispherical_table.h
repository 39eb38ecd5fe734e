#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::core {
class CsvNumbers;
}  // namespace evenglow::core

namespace evenglow::tracer {

/// What a film reflects and transmits into the whole hemisphere, against the angle of incidence, for light polarized
/// along its pass axis and along its block axis (as the ray sees them). CSV columns
/// `sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block`, optionally `lambda_nm`
/// (without it the values hold for every wavelength).
class HemisphericalTable {
 public:
  struct Row {
    double sigma = 0.0;  ///< rad
    double transmittance_pass = 0.0, reflectance_pass = 0.0;
    double transmittance_block = 0.0, reflectance_block = 0.0;
  };

  /// Throw `core::ConfigError`: everything `core::CsvNumbers` refuses, T + R > 1, the same angle (and wavelength)
  /// twice. Rows in any order.
  static HemisphericalTable read(const std::filesystem::path& file);
  static HemisphericalTable parse(std::string_view text, std::string name);

  /// nm, ascending; empty: the values hold for every wavelength.
  std::vector<double> wavelengths_nm() const;
  /// The values at one wavelength: linear in it between two of the table, held beyond them.
  HemisphericalTable at_wavelength(double lambda_nm) const;

  /// Linear in sigma (rad), held beyond the ends. A promise: the table has one wavelength (`at_wavelength`).
  Row at(double sigma) const;

 private:
  struct Level {
    double lambda_nm = 0.0;  ///< 0: every wavelength
    std::vector<Row> rows;   ///< ascending sigma
  };
  explicit HemisphericalTable(std::vector<Level> levels) : levels_(std::move(levels)) {}
  static HemisphericalTable make(const class core::CsvNumbers& numbers);
  static Row at(const std::vector<Row>& rows, double sigma);

  std::vector<Level> levels_;  ///< ascending wavelength
};

}  // namespace evenglow::tracer

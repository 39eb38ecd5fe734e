#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::tracer {

/// What a film reflects and transmits into the whole hemisphere, against the angle of incidence, for light polarized
/// along its pass axis and along its block axis (as the ray sees them). CSV columns
/// `sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block`.
class HemisphericalTable {
 public:
  struct Row {
    double sigma = 0.0;  ///< rad
    double transmittance_pass = 0.0, reflectance_pass = 0.0;
    double transmittance_block = 0.0, reflectance_block = 0.0;
  };

  /// Throw `core::ConfigError`: everything `CsvNumbers` refuses, T + R > 1, the same angle twice. Rows in any order.
  static HemisphericalTable read(const std::filesystem::path& file);
  static HemisphericalTable parse(std::string_view text, std::string name);

  const std::vector<Row>& rows() const { return rows_; }  ///< ascending sigma
  /// Linear in sigma (rad), held beyond the ends.
  Row at(double sigma) const;

 private:
  explicit HemisphericalTable(std::vector<Row> rows) : rows_(std::move(rows)) {}
  static HemisphericalTable make(const class CsvNumbers& numbers);
  std::vector<Row> rows_;
};

}  // namespace evenglow::tracer

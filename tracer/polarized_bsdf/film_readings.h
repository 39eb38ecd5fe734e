#pragma once

#include <compare>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/polarized_bsdf/bsdf_table.h"
#include "tracer/polarized_bsdf/polarizer.h"

namespace evenglow::tracer {

/// One direction pair and wavelength, as the file gives it: degrees and nm.
struct FilmNode {
  ScatterKind kind = ScatterKind::reflection;
  double psi_deg = 0.0, sigma_deg = 0.0, phi_deg = 0.0, theta_deg = 0.0, lambda_nm = 0.0;
  auto operator<=>(const FilmNode&) const = default;
  std::string to_string() const;  ///< `BRDF psi 0 sigma 10 phi 45 theta 5 lambda 550`
};

/// One reading. Angles in rad, as counted in the file; 0 where the polarizer has none.
struct FilmReading {
  PolarizerKind in_kind = PolarizerKind::none, out_kind = PolarizerKind::none;
  double in_angle = 0.0, out_angle = 0.0;
  double value = 0.0;  ///< 1/sr
  double se = 0.0;     ///< 1/sr; 0: not known
  int line = 0;
};

/// All readings of a node, in the order of the file.
struct ReadingGroup {
  FilmNode node;
  std::vector<FilmReading> readings;
};

/// A file of readings, in one of two formats (docs/films.md):
///
/// four angles: `kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,b0,b45,b90,b135`, optionally `se` (of each of the
/// four) or `se0,se45,se90,se135`. One of the four may be empty. Values 1/sr.
/// general: the same six, then `in_kind,in_angle_deg,out_kind,out_angle_deg,value,se`; kinds none, linear, right, left;
/// the angle of a polarizer that has none may be empty.
///
/// A node may be met any number of times, in any order; its readings are taken together.
class FilmReadings {
 public:
  /// Throw `core::ConfigError`: everything `core::CsvNumbers` refuses, no comment on the first line that names
  /// the units degrees, nm and 1/sr, others in it, a reading without error beside others with one, fewer than three
  /// angles at a node.
  static FilmReadings read(const std::filesystem::path& file);
  static FilmReadings parse(std::string_view text, std::string name);

  const std::string& name() const { return name_; }
  bool general() const { return general_; }
  bool has_errors() const { return has_errors_; }
  const std::vector<ReadingGroup>& groups() const { return groups_; }  ///< ascending by node

 private:
  friend class ReadingsBuilder;
  std::string name_;
  bool general_ = false;
  bool has_errors_ = false;
  std::vector<ReadingGroup> groups_;
};

}  // namespace evenglow::tracer

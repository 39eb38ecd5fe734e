#include "tracer/polarized_bsdf/mueller_check.h"

#include <array>

#include <fmt/format.h>

#include "core/light/mueller.h"
#include "tracer/polarized_bsdf/csv_numbers.h"
#include "tracer/polarized_bsdf/csv_units.h"

namespace evenglow::tracer {
namespace {

constexpr double kHuge = 1e12;
constexpr double kTolerance = 1e-6;  ///< the file holds 12 digits
constexpr std::size_t kFirstEntry = 6;

constexpr std::array<std::string_view, 16> kEntries{"m00", "m01", "m02", "m03", "m10", "m11", "m12", "m13",
                                                    "m20", "m21", "m22", "m23", "m30", "m31", "m32", "m33"};
constexpr std::array<std::string_view, 16> kErrors{"m00_se", "m01_se", "m02_se", "m03_se", "m10_se", "m11_se",
                                                   "m12_se", "m13_se", "m20_se", "m21_se", "m22_se", "m23_se",
                                                   "m30_se", "m31_se", "m32_se", "m33_se"};

std::vector<CsvColumn> columns() {
  std::vector<CsvColumn> table{{"kind", "BRDF or BTDF", 0, 0, false, true, {"BRDF", "BTDF"}},
                               {"psi_deg", "a number in [0, 180)", 0, 180, true},
                               {"sigma_deg", "a number in [0, 90)", 0, 90, true},
                               {"phi_deg", "a number in [0, 360)", 0, 360, true},
                               {"theta_deg", "a number in [0, 180)", 0, 180, true},
                               {"lambda_nm", "a number in [100, 10000]", 100, 10000}};
  for (const auto name : kEntries) table.push_back({name, "a number in [-1e12, 1e12]", -kHuge, kHuge});
  for (const auto name : kErrors) table.push_back({name, "a number in [0, 1e12]", 0, kHuge, false, false});
  for (const auto name : {"chi_square", "degrees_of_freedom", "chi_square_increase", "least_eigenvalue_se", "rest"}) {
    table.push_back({name, "a number in [0, 1e300]", 0, 1e300, false, false});
  }
  table.push_back({"least_eigenvalue", "a number in [-1e12, 1e12]", -kHuge, kHuge, false, false});
  return table;
}

std::optional<std::pair<std::size_t, std::string>> row_fault(std::span<const double> row) {
  core::MuellerMatrix M;
  for (int k = 0; k < 16; ++k) M(k / 4, k % 4) = row[kFirstEntry + static_cast<std::size_t>(k)];
  if (core::is_physical(M, kTolerance)) return std::nullopt;
  if (M(0, 0) <= 0.0) {
    return std::pair{kFirstEntry, fmt::format("must be above 0 unless the matrix is zero, got {}", M(0, 0))};
  }
  return std::pair{kFirstEntry, fmt::format("the matrix must be physical (no eigenvalue of its coherency matrix below "
                                            "-{} of the trace), got {:.3g}",
                                            kTolerance, core::least_coherency_eigenvalue(M))};
}

}  // namespace

bool is_mueller_file(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    if (!line.starts_with('#') && line.find_first_not_of(" \t\r") != std::string_view::npos) {
      return line.find("m00") != std::string_view::npos;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

std::vector<core::Fault> mueller_faults(std::string_view text, const std::string& name) {
  std::vector<core::Fault> faults;
  if (const auto fault = unit_fault(text, name, true)) faults.push_back(*fault);
  try {
    CsvNumbers::parse(text, name, columns(), row_fault);
  } catch (const core::ConfigError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
  return faults;
}

}  // namespace evenglow::tracer

#include "tracer/polarized_bsdf/mueller_columns.h"

#include <array>

#include <fmt/format.h>

#include "core/config/csv_numbers.h"
#include "core/light/mueller.h"

namespace evenglow::tracer {
namespace {

constexpr double kHuge = 1e12;

constexpr std::array<std::string_view, 16> kEntries{"m00", "m01", "m02", "m03", "m10", "m11", "m12", "m13",
                                                    "m20", "m21", "m22", "m23", "m30", "m31", "m32", "m33"};
constexpr std::array<std::string_view, 16> kErrors{"m00_se", "m01_se", "m02_se", "m03_se", "m10_se", "m11_se",
                                                   "m12_se", "m13_se", "m20_se", "m21_se", "m22_se", "m23_se",
                                                   "m30_se", "m31_se", "m32_se", "m33_se"};

std::vector<core::CsvColumn> made_columns() {
  std::vector<core::CsvColumn> table{{"kind", "BRDF or BTDF", 0, 0, false, true, {"BRDF", "BTDF"}},
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

}  // namespace

const std::vector<core::CsvColumn>& mueller_columns() {
  static const std::vector<core::CsvColumn> table = made_columns();
  return table;
}

std::optional<std::pair<std::size_t, std::string>> mueller_row_fault(std::span<const double> row) {
  core::MuellerMatrix M;
  for (int k = 0; k < 16; ++k) M(k / 4, k % 4) = row[kFirstEntry + static_cast<std::size_t>(k)];
  if (core::is_physical(M, kMuellerTolerance)) return std::nullopt;
  if (M(0, 0) <= 0.0) {
    return std::pair{kFirstEntry, fmt::format("must be above 0 unless the matrix is zero, got {}", M(0, 0))};
  }
  return std::pair{kFirstEntry, fmt::format("the matrix must be physical (no eigenvalue of its coherency matrix below "
                                            "-{} of the trace), got {:.3g}",
                                            kMuellerTolerance, core::least_coherency_eigenvalue(M))};
}

}  // namespace evenglow::tracer

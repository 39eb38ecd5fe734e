#include "tracer/polarized_bsdf/hemispherical_table.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/base/units.h"
#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

/// Sums of rounded decimals may pass 1 by their last digit.
constexpr double kRounding = 1e-9;
constexpr std::size_t kWavelength = 5;  ///< column

const std::vector<core::CsvColumn>& columns() {
  static const std::vector<core::CsvColumn> table{
      {"sigma_deg", "a number in [0, 90]", 0, 90},
      {"transmittance_pass", "a number in [0, 1]", 0, 1},
      {"reflectance_pass", "a number in [0, 1]", 0, 1},
      {"transmittance_block", "a number in [0, 1]", 0, 1},
      {"reflectance_block", "a number in [0, 1]", 0, 1},
      {"lambda_nm", "a number in [100, 10000]", 100, 10000, false, false},
  };
  return table;
}

std::optional<std::pair<std::size_t, std::string>> row_fault(std::span<const double> row) {
  for (const std::size_t i : {std::size_t{1}, std::size_t{3}}) {
    if (row[i] + row[i + 1] <= 1.0 + kRounding) continue;
    return std::pair{i + 1,
                     fmt::format("must be at most 1 - {} = {}, got {}", columns()[i].name, 1.0 - row[i], row[i + 1])};
  }
  return std::nullopt;
}

}  // namespace

HemisphericalTable HemisphericalTable::read(const std::filesystem::path& file) {
  return make(core::CsvNumbers::read(file, columns(), row_fault));
}

HemisphericalTable HemisphericalTable::parse(std::string_view text, std::string name) {
  return make(core::CsvNumbers::parse(text, std::move(name), columns(), row_fault));
}

HemisphericalTable HemisphericalTable::make(const core::CsvNumbers& numbers) {
  std::vector<std::size_t> order(numbers.rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto wavelength = [&](std::size_t r) { return numbers.has(kWavelength) ? numbers.value(r, kWavelength) : 0.0; };
  std::ranges::stable_sort(order, {}, [&](std::size_t r) { return std::pair{wavelength(r), numbers.value(r, 0)}; });
  std::vector<Level> levels;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t r = order[i];
    if (levels.empty() || levels.back().lambda_nm != wavelength(r)) {
      levels.push_back({wavelength(r), {}});
    } else if (numbers.value(order[i - 1], 0) == numbers.value(r, 0)) {
      throw core::ConfigError(core::Fault{numbers.name(), numbers.line(r), 1, "sigma_deg",
                                          fmt::format("must hold each angle once, got {} again (first on line {})",
                                                      numbers.value(r, 0), numbers.line(order[i - 1]))});
    }
    levels.back().rows.push_back({numbers.value(r, 0) * core::kRadPerDeg, numbers.value(r, 1), numbers.value(r, 2),
                                  numbers.value(r, 3), numbers.value(r, 4)});
  }
  return HemisphericalTable(std::move(levels));
}

namespace {

HemisphericalTable::Row mixed(const HemisphericalTable::Row& a, const HemisphericalTable::Row& b, double t,
                              double sigma) {
  const auto between = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  return {sigma, between(a.transmittance_pass, b.transmittance_pass), between(a.reflectance_pass, b.reflectance_pass),
          between(a.transmittance_block, b.transmittance_block), between(a.reflectance_block, b.reflectance_block)};
}

}  // namespace

HemisphericalTable::Row HemisphericalTable::at(const std::vector<Row>& rows, double sigma) {
  if (sigma <= rows.front().sigma) return rows.front();
  if (sigma >= rows.back().sigma) return rows.back();
  const auto next = std::ranges::upper_bound(rows, sigma, {}, &Row::sigma);
  const Row& a = *(next - 1);
  return mixed(a, *next, (sigma - a.sigma) / (next->sigma - a.sigma), sigma);
}

HemisphericalTable::Row HemisphericalTable::at(double sigma) const {
  core::expects(levels_.size() == 1, "hemispherical totals are asked for at one wavelength");
  return at(levels_.front().rows, sigma);
}

std::vector<double> HemisphericalTable::wavelengths_nm() const {
  std::vector<double> wavelengths;
  for (const Level& level : levels_) {
    if (level.lambda_nm > 0.0) wavelengths.push_back(level.lambda_nm);
  }
  return wavelengths;
}

HemisphericalTable HemisphericalTable::at_wavelength(double lambda_nm) const {
  const auto next = std::ranges::upper_bound(levels_, lambda_nm, {}, &Level::lambda_nm);
  if (next == levels_.begin()) return HemisphericalTable({levels_.front()});
  if (next == levels_.end()) return HemisphericalTable({levels_.back()});
  const Level& low = *(next - 1);
  std::vector<double> sigmas;
  for (const Level* level : {&low, &*next}) {
    for (const Row& row : level->rows) sigmas.push_back(row.sigma);
  }
  std::ranges::sort(sigmas);
  sigmas.erase(std::unique(sigmas.begin(), sigmas.end()), sigmas.end());
  Level level{lambda_nm, {}};
  const double t = (lambda_nm - low.lambda_nm) / (next->lambda_nm - low.lambda_nm);
  for (const double sigma : sigmas) level.rows.push_back(mixed(at(low.rows, sigma), at(next->rows, sigma), t, sigma));
  return HemisphericalTable({std::move(level)});
}

}  // namespace evenglow::tracer

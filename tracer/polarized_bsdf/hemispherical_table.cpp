#include "tracer/polarized_bsdf/hemispherical_table.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/polarized_bsdf/csv_numbers.h"

namespace evenglow::tracer {
namespace {

/// Sums of rounded decimals may pass 1 by their last digit.
constexpr double kRounding = 1e-9;

const std::vector<CsvColumn>& columns() {
  static const std::vector<CsvColumn> table{
      {"sigma_deg", "a number in [0, 90]", 0, 90},       {"transmittance_pass", "a number in [0, 1]", 0, 1},
      {"reflectance_pass", "a number in [0, 1]", 0, 1},  {"transmittance_block", "a number in [0, 1]", 0, 1},
      {"reflectance_block", "a number in [0, 1]", 0, 1},
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
  return make(CsvNumbers::read(file, columns(), row_fault));
}

HemisphericalTable HemisphericalTable::parse(std::string_view text, std::string name) {
  return make(CsvNumbers::parse(text, std::move(name), columns(), row_fault));
}

HemisphericalTable HemisphericalTable::make(const CsvNumbers& numbers) {
  std::vector<std::size_t> order(numbers.rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t r) { return numbers.value(r, 0); });
  std::vector<Row> rows;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t r = order[i];
    if (i > 0 && numbers.value(order[i - 1], 0) == numbers.value(r, 0)) {
      throw core::ConfigError(core::Fault{numbers.name(), numbers.line(r), 1, "sigma_deg",
                                          fmt::format("must hold each angle once, got {} again (first on line {})",
                                                      numbers.value(r, 0), numbers.line(order[i - 1]))});
    }
    rows.push_back({numbers.value(r, 0) * core::kRadPerDeg, numbers.value(r, 1), numbers.value(r, 2),
                    numbers.value(r, 3), numbers.value(r, 4)});
  }
  return HemisphericalTable(std::move(rows));
}

HemisphericalTable::Row HemisphericalTable::at(double sigma) const {
  if (sigma <= rows_.front().sigma) return rows_.front();
  if (sigma >= rows_.back().sigma) return rows_.back();
  const auto next = std::ranges::upper_bound(rows_, sigma, {}, &Row::sigma);
  const Row& a = *(next - 1);
  const Row& b = *next;
  const double t = (sigma - a.sigma) / (b.sigma - a.sigma);
  const auto mixed = [t](double x, double y) { return (1.0 - t) * x + t * y; };
  return {sigma, mixed(a.transmittance_pass, b.transmittance_pass), mixed(a.reflectance_pass, b.reflectance_pass),
          mixed(a.transmittance_block, b.transmittance_block), mixed(a.reflectance_block, b.reflectance_block)};
}

}  // namespace evenglow::tracer

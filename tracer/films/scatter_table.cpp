#include "tracer/films/scatter_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

enum Column : std::size_t { kIncidence, kTheta, kPhi, kBrdf, kBtdf };

const std::vector<core::CsvColumn>& columns() {
  static const std::vector<core::CsvColumn> table{
      {"incidence_deg", "a number in [0, 90)", 0, 90, true},
      {"theta_deg", "a number in [0, 180)", 0, 180, true},
      {"phi_deg", "a number in [0, 180]", 0, 180, false, false},
      {"brdf", "a number of at least 0", 0, 1e12, false, false},
      {"btdf", "a number of at least 0", 0, 1e12, false, false},
  };
  return table;
}

[[noreturn]] void refuse(const core::CsvNumbers& numbers, int line, const std::string& column,
                         const std::string& what) {
  throw core::ConfigError(core::Fault{numbers.name(), line, line > 0 ? 1 : 0, column, what});
}

std::vector<double> nodes_of(const core::CsvNumbers& numbers, std::size_t column) {
  if (!numbers.has(column)) return {0.0};
  std::vector<double> nodes;
  for (std::size_t row = 0; row < numbers.rows(); ++row) nodes.push_back(numbers.value(row, column));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// What the spline around the turn can take: its work grows as the cube of the number of nodes.
constexpr std::size_t kMostPhi = 361;
constexpr double kLeastPhiStep = 0.01;  // degrees

void check_phi(const core::CsvNumbers& numbers, const std::vector<double>& phi) {
  if (phi.size() > kMostPhi) {
    refuse(numbers, 0, "phi_deg", fmt::format("must have at most {} values, got {}", kMostPhi, phi.size()));
  }
  for (std::size_t i = 1; i < phi.size(); ++i) {
    if (phi[i] - phi[i - 1] >= kLeastPhiStep) continue;
    refuse(numbers, 0, "phi_deg",
           fmt::format("must have steps of at least {}, got {} and {}", kLeastPhiStep, phi[i - 1], phi[i]));
  }
}

std::size_t index_in(const std::vector<double>& nodes, double value) {
  return static_cast<std::size_t>(std::lower_bound(nodes.begin(), nodes.end(), value) - nodes.begin());
}

/// Rows sorted to the grid, phi fastest.
class ScatterGrid {
 public:
  explicit ScatterGrid(const core::CsvNumbers& numbers)
      : numbers_(numbers),
        incidence_(nodes_of(numbers, kIncidence)),
        theta_(nodes_of(numbers, kTheta)),
        phi_(nodes_of(numbers, kPhi)) {
    check_phi(numbers, phi_);
    sort();
    mirror();
  }

  BsdfTable table() const {
    std::array<std::vector<BsdfTable::Node>, 2> nodes;
    double largest = 0.0;
    for (std::size_t kind = 0; kind < 2; ++kind) {
      if (!numbers_.has(kBrdf + kind)) continue;
      double here = 0.0;
      for (const std::size_t row : order_) {
        const double value = numbers_.value(row, kBrdf + kind);
        here = std::max(here, value);
        nodes[kind].push_back({value, value});
      }
      if (here <= 0.0) nodes[kind].clear();  // a kind of light that the film does not send
      largest = std::max(largest, here);
    }
    if (largest <= 0.0) refuse(numbers_, 0, "", "must have a column brdf or btdf with values above 0, got none");
    BsdfTable::Axes axes;
    axes.psi = {0.0};
    axes.lambda_nm = {550.0};
    for (const double angle : incidence_) axes.sigma.push_back(angle * core::kRadPerDeg);
    for (const double angle : theta_) axes.theta.push_back(angle * core::kRadPerDeg);
    for (const double angle : turn_) axes.phi.push_back(angle * core::kRadPerDeg);
    return BsdfTable::from_nodes(numbers_.name(), std::move(axes), std::move(nodes));
  }

 private:
  void sort() {
    // Before the grid is made: a file of scattered angles must not ask for more than a few times its own size.
    const double wanted =
        static_cast<double>(incidence_.size()) * static_cast<double>(theta_.size()) * static_cast<double>(phi_.size());
    if (wanted > 4.0 * static_cast<double>(numbers_.rows()) + 1000.0) refuse_gaps(wanted);
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    rows_.assign(static_cast<std::size_t>(wanted), kNone);
    for (std::size_t row = 0; row < numbers_.rows(); ++row) {
      const std::size_t phi = numbers_.has(kPhi) ? index_in(phi_, numbers_.value(row, kPhi)) : 0;
      std::size_t& place = rows_[(index_in(incidence_, numbers_.value(row, kIncidence)) * theta_.size() +
                                  index_in(theta_, numbers_.value(row, kTheta))) *
                                     phi_.size() +
                                 phi];
      if (place != kNone) {
        refuse(numbers_, numbers_.line(row), "incidence_deg",
               fmt::format("must hold each direction once, got that of line {} again", numbers_.line(place)));
      }
      place = row;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i] != kNone) continue;
      refuse(numbers_, 0, "",
             fmt::format("must be a full grid, got no row for incidence_deg {:g}, theta_deg {:g}{}",
                         incidence_[i / phi_.size() / theta_.size()], theta_[i / phi_.size() % theta_.size()],
                         numbers_.has(kPhi) ? fmt::format(", phi_deg {:g}", phi_[i % phi_.size()]) : ""));
    }
  }

  [[noreturn]] void refuse_gaps(double wanted) const {
    refuse(numbers_, 0, "",
           fmt::format("must be a full grid of {} incidences x {} theta x {} phi = {:g} rows, got {}",
                       incidence_.size(), theta_.size(), phi_.size(), wanted, numbers_.rows()));
  }

  /// The whole turn of phi out of its half.
  void mirror() {
    std::vector<std::size_t> source;
    for (std::size_t p = 0; p < phi_.size(); ++p) source.push_back(p);
    turn_ = phi_;
    for (std::size_t p = phi_.size(); p-- > 0;) {
      if (!numbers_.has(kPhi) || phi_[p] == 0.0 || phi_[p] == 180.0) continue;
      source.push_back(p);
      turn_.push_back(360.0 - phi_[p]);
    }
    for (std::size_t line = 0; line < incidence_.size() * theta_.size(); ++line) {
      for (const std::size_t p : source) order_.push_back(rows_[line * phi_.size() + p]);
    }
  }

  const core::CsvNumbers& numbers_;
  std::vector<double> incidence_, theta_, phi_;  ///< degrees, ascending
  std::vector<double> turn_;                     ///< phi over the whole turn
  std::vector<std::size_t> rows_, order_;        ///< row of each node: of the file's grid, of the whole turn
};

}  // namespace

BsdfTable read_scatter_table(const std::filesystem::path& file) {
  return ScatterGrid(core::CsvNumbers::read(file, columns())).table();
}

BsdfTable parse_scatter_table(std::string_view text, std::string name) {
  return ScatterGrid(core::CsvNumbers::parse(text, std::move(name), columns())).table();
}

}  // namespace evenglow::tracer

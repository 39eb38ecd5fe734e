#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/report/report.h"

namespace evenglow::design {

/// Where light may end. Their order is that of the flow diagram, from above.
enum class Fate { top, side, absorbed, lost };

/// One destination of light, with its share in each report (none: no such part there).
struct Destination {
  std::string label;
  Fate fate = Fate::absorbed;
  std::vector<std::optional<core::Estimate>> shares;

  double greatest() const;
};

/// The energy accounts of reports, row by row: what leaves by the top first, then by size (the greatest of all).
class EnergyRows {
 public:
  explicit EnergyRows(const std::vector<const Report*>& reports);

  const std::vector<Destination>& rows() const { return rows_; }
  double sum(std::size_t report) const;

 private:
  void add(const std::string& label, Fate fate, std::size_t report, const core::Estimate& share);

  std::size_t count_;
  std::vector<Destination> rows_;
};

/// Class of row `index` in the style sheet: e0 to e9, e10 for all the rest.
std::string energy_class(std::size_t index);

}  // namespace evenglow::design

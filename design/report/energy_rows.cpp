#include "design/report/energy_rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace evenglow::design {

double Destination::greatest() const {
  double most = 0.0;
  for (const auto& share : shares) most = std::max(most, share ? share->value : 0.0);
  return most;
}

EnergyRows::EnergyRows(const std::vector<const Report*>& reports) : count_(reports.size()) {
  for (std::size_t i = 0; i < count_; ++i) {
    const EnergyAccount& energy = reports[i]->energy;
    for (const EnergyShare& s : energy.escaped)
      add("leaves by the " + s.name, s.name == "top" ? Fate::top : Fate::side, i, s.share);
    for (const EnergyShare& s : energy.absorbed) add("absorbed: " + s.name, Fate::absorbed, i, s.share);
    add("lost photons (stopped by the program)", Fate::lost, i, energy.lost);
  }
  std::stable_sort(rows_.begin(), rows_.end(), [](const Destination& a, const Destination& b) {
    const bool top_a = a.fate == Fate::top;
    const bool top_b = b.fate == Fate::top;
    return top_a != top_b ? top_a : a.greatest() > b.greatest();
  });
}

double EnergyRows::sum(std::size_t report) const {
  double total = 0.0;
  for (const Destination& row : rows_) total += row.shares[report] ? row.shares[report]->value : 0.0;
  return total;
}

void EnergyRows::add(const std::string& label, Fate fate, std::size_t report, const core::Estimate& share) {
  auto row = std::find_if(rows_.begin(), rows_.end(),
                          [&](const Destination& d) { return d.label == label && !d.shares[report]; });
  if (row == rows_.end()) {
    rows_.push_back({label, fate, std::vector<std::optional<core::Estimate>>(count_)});
    row = rows_.end() - 1;
  }
  row->shares[report] = share;
}

std::string energy_class(std::size_t index) {
  return fmt::format("e{}", std::min<std::size_t>(index, 10));
}

}  // namespace evenglow::design

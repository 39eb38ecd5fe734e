#pragma once

#include <array>
#include <map>
#include <string>

namespace evenglow::tracer {

/// What a film is given beyond the last angle of incidence of its table: the lobes of that incidence, which the horizon
/// would cut more and more, scaled to the power for natural light that they have there.
class HeldTotals {
 public:
  explicit HeldTotals(double last_sigma) : last_(last_sigma) {}  ///< rad

  bool is_beyond(double sigma) const { return sigma > last_ + 1e-9; }
  double last_sigma() const { return last_; }

  /// Totals of each kind at the last incidence, by psi; `totals()` makes them at the first call for a psi.
  template <typename Totals>
  const std::array<double, 2>& at(double psi, Totals&& totals) {
    auto [edge, is_new] = by_psi_.try_emplace(psi);
    if (is_new) edge->second = totals();
    return edge->second;
  }

  /// Tells the user where the data of `name` end; empty if they go far enough. `totals_given`: by another table.
  std::string remark(const std::string& name, bool totals_given) const;

 private:
  double last_;
  std::map<double, std::array<double, 2>> by_psi_;
};

}  // namespace evenglow::tracer

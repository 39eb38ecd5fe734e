#include "design/updaters/spline_updater.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <nlopt.hpp>

#include "core/base/error.h"
#include "core/math/cell_index.h"
#include "design/updaters/level.h"

namespace evenglow::design {
namespace {

constexpr double kReach = 3.0;      // of a coefficient, in ln density
constexpr double kFirstStep = 0.5;  // of a coefficient
constexpr double kFinest = 1e-3;    // change of the coefficients that ends the search

// Names in the memory.
constexpr const char* kBase = "spline.base";
constexpr const char* kValues = "spline.values";

/// B-splines of degree p on a clamped uniform knot vector at u in [0, 1] (de Boor's recursion).
std::vector<double> basis(int count, double u) {
  const int degree = std::min(3, count - 1);
  const int spans = count - degree;
  const auto knot = [&](int i) { return std::clamp(static_cast<double>(i - degree) / spans, 0.0, 1.0); };
  std::vector<double> b(static_cast<std::size_t>(count + degree), 0.0);
  const int span = degree + std::min(static_cast<int>(u * spans), spans - 1);
  b[static_cast<std::size_t>(span)] = 1.0;
  for (int p = 1; p <= degree; ++p) {
    for (int i = 0; i + p < count + degree; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double left = knot(i + p) - knot(i);
      const double right = knot(i + p + 1) - knot(i + 1);
      const double next = k + 1 < b.size() ? b[k + 1] : 0.0;
      b[k] =
          (left > 0.0 ? (u - knot(i)) / left * b[k] : 0.0) + (right > 0.0 ? (knot(i + p + 1) - u) / right * next : 0.0);
    }
  }
  b.resize(static_cast<std::size_t>(count));
  return b;
}

nlopt::algorithm algorithm_of(const std::string& name) {
  if (name == "cobyla") return nlopt::LN_COBYLA;
  if (name == "sbplx") return nlopt::LN_SBPLX;
  return nlopt::LN_BOBYQA;
}

/// Plays known values to the search until it asks for more.
class Replay {
 public:
  Replay(const std::vector<double>& values, std::size_t coefficients) : values_(values), best_(coefficients, 0.0) {}

  double value_at(const std::vector<double>& point) {
    if (asked_ == values_.size()) {
      next_ = point;
      throw nlopt::forced_stop();
    }
    const double value = values_[asked_++];
    if (asked_ == 1 || value < least_) {
      least_ = value;
      best_ = point;
    }
    return value;
  }
  /// The first unknown point; the best known one if the search came to its end before.
  const std::vector<double>& next() const { return next_ ? *next_ : best_; }

 private:
  const std::vector<double>& values_;
  std::size_t asked_ = 0;
  double least_ = 0.0;
  std::vector<double> best_;
  std::optional<std::vector<double>> next_;
};

std::vector<double> next_point(const std::vector<double>& values, const SplineSpec& spec) {
  const auto count = static_cast<std::size_t>(spec.nx) * static_cast<std::size_t>(spec.ny);
  Replay replay(values, count);
  nlopt::opt search(algorithm_of(spec.method), static_cast<unsigned>(count));
  search.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                              void* data) { return static_cast<Replay*>(data)->value_at(x); },
                           &replay);
  search.set_lower_bounds(-kReach);
  search.set_upper_bounds(kReach);
  search.set_initial_step(kFirstStep);
  search.set_xtol_abs(kFinest);
  std::vector<double> x(count, 0.0);
  double least = 0.0;
  try {
    search.optimize(x, least);
  } catch (const nlopt::forced_stop&) {  // the next point is known
  } catch (const nlopt::roundoff_limited&) {
  }
  return replay.next();
}

class SplineUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory& memory) const override {
    auto& base = memory[kBase];
    auto& values = memory[kValues];
    if (base.size() != state.density.cells.values.size()) base = state.density.cells.values;
    values.push_back(state.record.rms_corrected.value);
    const core::CellField factor =
        spline_field(state.density.cells.grid, spec.spline.nx, spec.spline.ny, next_point(values, spec.spline));
    tracer::DensityField shape = state.density;
    for (std::size_t i = 0; i < base.size(); ++i) shape.cells.values[i] = base[i] * std::exp(factor.values[i]);
    return with_level(std::move(shape), state.density.cells.mean(), spec);
  }

  /// The first model of the search alone takes 2 n + 1 values.
  int patience(const DesignSpec& spec) const override { return 4 * spec.spline.nx * spec.spline.ny + 6; }
};

}  // namespace

core::CellField spline_field(const core::CellGrid& grid, int nx, int ny, const std::vector<double>& coefficients) {
  core::expects(coefficients.size() == static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny),
                "a value for each coefficient");
  std::vector<std::vector<double>> columns;
  columns.reserve(static_cast<std::size_t>(grid.nx));
  for (int ix = 0; ix < grid.nx; ++ix) columns.push_back(basis(nx, (ix + 0.5) / grid.nx));
  core::CellField field(grid, 0.0);
  for (int iy = 0; iy < grid.ny; ++iy) {
    const std::vector<double> row = basis(ny, (iy + 0.5) / grid.ny);
    for (int ix = 0; ix < grid.nx; ++ix) {
      double& value = field.values[core::cell_index(grid.nx, ix, iy)];
      for (std::size_t j = 0; j < row.size(); ++j) {
        for (std::size_t i = 0; i < columns[static_cast<std::size_t>(ix)].size(); ++i) {
          value +=
              row[j] * columns[static_cast<std::size_t>(ix)][i] * coefficients[j * static_cast<std::size_t>(nx) + i];
        }
      }
    }
  }
  return field;
}

std::unique_ptr<const Updater> make_spline_updater() {
  return std::make_unique<SplineUpdater>();
}

}  // namespace evenglow::design

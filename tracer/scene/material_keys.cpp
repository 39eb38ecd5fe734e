#include "tracer/scene/material_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/csv_numbers.h"
#include "core/light/cie_1931.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;
using Law = std::function<double(double)>;  ///< of the wavelength, nm

constexpr Range kIndex = Range::closed(1.0001, 4);
constexpr Range kLoss = Range::closed(0, 1e5);
constexpr double kPeak = 550.0;

/// Rows of wavelength and value, linear between them and held beyond.
struct Curve {
  std::vector<double> wavelength, value;

  double operator()(double nm) const {
    const auto next = std::upper_bound(wavelength.begin(), wavelength.end(), nm) - wavelength.begin();
    if (next == 0) return value.front();
    const auto i = static_cast<std::size_t>(next);
    if (i == wavelength.size()) return value.back();
    const double t = (nm - wavelength[i - 1]) / (wavelength[i] - wavelength[i - 1]);
    return (1.0 - t) * value[i - 1] + t * value[i];
  }
};

Curve read_curve(const std::filesystem::path& file, std::string_view name, std::string_view allowed,
                 const Range& range) {
  const std::array<core::CsvColumn, 2> columns{
      core::CsvColumn{"wavelength_nm", "a wavelength in [100, 10000] nm", 100.0, 10000.0},
      core::CsvColumn{name, allowed, range.min, range.max}};
  const core::CsvNumbers rows = core::CsvNumbers::read(file, columns);
  Curve curve;
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    if (i > 0 && !(rows.value(i, 0) > curve.wavelength.back())) {
      throw core::ConfigError(core::Fault{file.string(), rows.line(i), 0, "wavelength_nm",
                                          fmt::format("must be larger than that of the row before ({:g}), got {:g}",
                                                      curve.wavelength.back(), rows.value(i, 0))});
    }
    curve.wavelength.push_back(rows.value(i, 0));
    curve.value.push_back(rows.value(i, 1));
  }
  return curve;
}

std::optional<Law> read_sellmeier(const ConfigNode& node) {
  const auto b = node.numbers({"b", "strengths", Range::closed(-1e3, 1e3), 1, 6, {}});
  const auto c = node.numbers({"c_um2", "squares of the resonance wavelengths, um^2", Range::closed(0, 1e4), 1, 6, {}});
  if (b.size() != c.size()) {
    node.fault_at("c_um2", fmt::format("must have as many numbers as b ({}), got {}", b.size(), c.size()));
    return {};
  }
  constexpr double kLow = core::kShortestVisible * core::kShortestVisible * 1e-6;
  constexpr double kHigh = core::kLongestVisible * core::kLongestVisible * 1e-6;
  for (const double square : c) {
    if (square < kLow || square > kHigh) continue;
    node.fault_at("c_um2", fmt::format("must not have a resonance between 380 and 780 nm ({:g} to {:g} um^2), got {:g}",
                                       kLow, kHigh, square));
    return {};
  }
  return [b, c](double nm) {
    const double l2 = nm * nm * 1e-6;
    double square = 1.0;
    for (std::size_t i = 0; i < b.size(); ++i) square += b[i] * l2 / (l2 - c[i]);
    return std::sqrt(square);
  };
}

std::optional<Law> read_cauchy(const ConfigNode& node) {
  const double a = node.number({"a", "index at long wavelengths", Range::closed(1, 4), {}});
  const double b = node.number({"b_um2", "of the term in 1/l^2, um^2", Range::closed(-1, 1), 0.0});
  const double c = node.number({"c_um4", "of the term in 1/l^4, um^4", Range::closed(-1, 1), 0.0});
  return [a, b, c](double nm) {
    const double l2 = nm * nm * 1e-6;
    return a + b / l2 + c / (l2 * l2);
  };
}

std::optional<Law> read_dispersion(const ConfigNode& node) {
  const auto kind = node.kind({"kind", "which formula the index follows", {"sellmeier", "cauchy", "table"}, {}});
  if (!kind) return {};
  std::optional<Law> law;
  if (*kind == "sellmeier") law = read_sellmeier(node);
  if (*kind == "cauchy") law = read_cauchy(node);
  if (*kind == "table") {
    const auto file = node.file({"file", "CSV of wavelength_nm and refractive_index", {}});
    if (file.empty()) return {};
    const auto curve =
        node.guarded("file", [&] { return read_curve(file, "refractive_index", "a number in [1.0001, 4]", kIndex); });
    if (!curve) return {};
    law = Law(*curve);
  }
  for (double nm = core::kShortestVisible; law && nm <= core::kLongestVisible; nm += 10.0) {
    const double n = (*law)(nm);
    if (kIndex.contains(n)) continue;
    node.fault(
        fmt::format("must give an index in {} from 380 to 780 nm, got {:.6g} at {:g} nm", kIndex.to_string(), n, nm));
    return {};
  }
  return law;
}

/// `key` beside another key that says the same.
void refuse_beside(const ConfigNode& node, std::string_view key, std::string_view other) {
  if (node.has(key) && node.has(other)) {
    node.fault_at(key, fmt::format("must be left out where {} is given, got both", other));
  }
}

/// Index law and, for a named material, its own loss in 1/m.
struct IndexLaw {
  Law index;
  double loss_per_m = 0.0;
};

IndexLaw read_index(const ConfigNode& node) {
  refuse_beside(node, "material", "refractive_index");
  refuse_beside(node, "material", "dispersion");
  refuse_beside(node, "refractive_index", "dispersion");
  if (node.has("dispersion")) {
    const auto law = read_dispersion(node.map("dispersion", "index against wavelength, instead of a material"));
    if (node.has("material")) node.choice({"material", "material of the plate", material_names(), "pmma"});
    if (node.has("refractive_index")) node.number({"refractive_index", "index of the plate", kIndex, {}});
    return {law.value_or(Law([](double) { return 1.49; })), 0.0};
  }
  if (node.has("refractive_index")) {
    if (node.has("material")) node.choice({"material", "material of the plate", material_names(), "pmma"});
    const double n = node.number({"refractive_index", "index of the plate, instead of a material", kIndex, {}});
    return {[n](double) { return n; }, 0.0};
  }
  const std::string name = node.choice({"material", "material of the plate", material_names(), "pmma"});
  return {[name](double nm) { return material(name, nm).refractive_index; },
          material(name, kPeak).absorption * core::kMmPerM};
}

}  // namespace

std::function<Material(double)> read_material(const ConfigNode& node) {
  const IndexLaw law = read_index(node);
  refuse_beside(node, "absorption_file", "absorption_per_m");
  const auto file =
      node.file({"absorption_file", "CSV of wavelength_nm and absorption_per_m, instead of one number", std::string()});
  const double loss =
      node.number({"absorption_per_m", "bulk absorption; default: that of the material, 0 with an index of your own",
                   kLoss, law.loss_per_m});
  if (!file.empty()) {
    const auto curve = node.guarded(
        "absorption_file", [&] { return read_curve(file, "absorption_per_m", "a number in [0, 1e5]", kLoss); });
    if (curve) {
      return [index = law.index, curve = *curve](double nm) { return Material{index(nm), curve(nm) / core::kMmPerM}; };
    }
  }
  return [index = law.index, loss](double nm) { return Material{index(nm), loss}; };
}

}  // namespace evenglow::tracer

#include "tracer/goniometer/goniometer_spec.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/film_registry.h"

namespace evenglow::tracer {
namespace {

using core::Range;
constexpr double kSame = 1e-9;  // rad

/// A list of angles (rad), each once.
std::vector<double> angles(const core::ConfigNode& node, const core::NumbersKey& key) {
  std::vector<double> values = node.numbers(key);
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] < kSame) {
      node.fault_at(key.key, fmt::format("each angle may stand once, got {:g} twice", sorted[i] / core::kRadPerDeg));
      break;
    }
  }
  return values;
}

void read_film(const core::ConfigNode& node, GoniometerSpec& spec) {
  auto film = film_registry().make(node);
  if (!film) return;
  if (film->surface && !film->surface->scatters()) {
    constexpr const char* kAllowed = "must scatter (kind dbef with table or model, mueller_table, or diffuser)";
    node.fault(fmt::format("{}, got {}", kAllowed,
                           film->surface->redirects()
                               ? "a film that only redirects, into single directions that the detector misses"
                               : "a specular film, which no detector sees"));
  } else if (film->sheet) {
    node.fault("must be a film, got a sheet with a body");
  }
  spec.film = std::move(*film);
  if (spec.film.kind == "dbef" && has_dbef_data(node) && spec.film.surface) spec.data = read_dbef_data(node);
}

bool holds(const std::vector<double>& angles, double angle) {
  return std::any_of(angles.begin(), angles.end(), [&](double a) { return std::abs(a - angle) < kSame; });
}

void read_measured(const core::ConfigNode& node, GoniometerSpec& spec) {
  const std::pair<const char*, ScatterKind> tables[] = {{"reflection", ScatterKind::reflection},
                                                        {"transmission", ScatterKind::transmission}};
  for (const auto& [key, kind] : tables) {
    if (!node.has(key)) continue;
    const auto path = node.file({key, "measured luminance to compare with (CSV)", std::string()});
    if (path.empty()) continue;
    auto table = node.guarded(key, [&, k = kind] { return LuminanceTable::read(path, k); });
    if (!table) continue;
    for (const LuminanceRow& row : table->rows) {
      if (holds(spec.psi, row.psi) && holds(spec.theta, row.theta) &&
          (!row.filtered || holds(spec.filter.angles, row.filter))) {
        continue;
      }
      node.fault_at(key, fmt::format("settings must be among psi_deg, theta_deg and angles_deg of the goniometer, got "
                                     "psi {:g}, theta {:g}, {}",
                                     row.psi / core::kRadPerDeg, row.theta / core::kRadPerDeg, illumination_name(row)));
      break;
    }
    spec.measured.push_back(std::move(*table));
  }
}

void read_filter(const core::ConfigNode& node, GoniometerSpec& spec) {
  spec.filter.k1 =
      node.number({"k1", "transmittance of light along the pass axis of the filter", Range::closed(0, 1), 0.9});
  spec.filter.k2 = node.number({"k2", "transmittance of light across it", Range::closed(0, 1), 0.0});
  if (spec.filter.k2 > spec.filter.k1) {
    node.fault_at("k2", fmt::format("must be at most k1 = {:g}, got {:g}", spec.filter.k1, spec.filter.k2));
  }
  spec.filter.angles = angles(node, {"angles_deg",
                                     "angles of the filter's pass axis from the plane of incidence",
                                     {0, 180, false, true},
                                     0,
                                     180,
                                     std::vector<double>{0, 45, 90},
                                     true});
  const Range offset = Range::closed(-45, 45);
  spec.offset_reflection =
      node.number({"offset_reflection_deg",
                   "from psi to the film's axis of polarization that the filter sees, reflection", offset, 0.0});
  spec.offset_transmission = node.number({"offset_transmission_deg", "the same for transmission", offset, 0.0});
}

}  // namespace

GoniometerSpec read_goniometer(const core::ConfigNode& node) {
  GoniometerSpec spec;
  read_film(node.map("film", "film on the goniometer", true), spec);
  const core::ConfigNode lamp = node.map("lamp", "light source, far away");
  spec.illuminance = lamp.number({"illuminance_lx", "on the film, without the filter", Range::positive(1e9), 409.15});
  spec.sigma = lamp.number({"sigma_deg", "angle of incidence", Range::closed(0, 85), 0.0});
  read_filter(node.map("filter", "linear polarizer between lamp and film"), spec);
  const core::ConfigNode detector = node.map("detector", "luminance meter that looks at the film");
  spec.theta = angles(detector, {"theta_deg",
                                 "angle of observation from the specular or direct axis",
                                 {0, 90, false, true},
                                 1,
                                 1000,
                                 std::vector<double>{10, 20, 30, 40, 50, 60}});
  spec.acceptance = detector.number(
      {"acceptance_deg", "half-angle of the cone that the detector averages over", Range::positive(10), 0.5});
  for (const double theta : spec.theta) {
    if (spec.sigma + theta + spec.acceptance < 0.5 * core::kPi) continue;
    detector.fault_at("theta_deg", fmt::format("sigma_deg + theta_deg + acceptance_deg must stay below 90, got {:g}",
                                               (spec.sigma + theta + spec.acceptance) / core::kRadPerDeg));
    break;
  }
  spec.psi =
      angles(node, {"psi_deg", "rotations of the film", {0, 360, false, true}, 1, 360, std::vector<double>{0, 45, 90}});
  read_measured(node.map("measured", "luminance tables to compare with"), spec);
  return spec;
}

}  // namespace evenglow::tracer

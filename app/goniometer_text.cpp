#include "app/goniometer_text.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/version.h"

namespace evenglow::app {
namespace {

using tracer::GoniometerColumn;
using tracer::GoniometerResult;
using tracer::GoniometerRow;
using tracer::GoniometerSpec;
using tracer::LuminanceMetrics;
using tracer::ScatterKind;
using Json = nlohmann::ordered_json;

constexpr std::array<std::pair<GoniometerColumn, const char*>, 4> kColumns{{{GoniometerColumn::published, "published"},
                                                                            {GoniometerColumn::table, "table"},
                                                                            {GoniometerColumn::film, "film"},
                                                                            {GoniometerColumn::traced, "traced"}}};
constexpr std::array<std::pair<std::optional<ScatterKind>, const char*>, 3> kKinds{
    {{ScatterKind::reflection, "reflection"}, {ScatterKind::transmission, "transmission"}, {std::nullopt, "both"}}};

double degrees(double rad) {
  return std::round(rad / core::kRadPerDeg * 1e9) / 1e9;
}

std::string entry(std::optional<double> value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::optional<double> given(double value) {
  return value >= 0.0 ? std::optional(value) : std::nullopt;
}

Json metrics_json(const LuminanceMetrics& m) {
  return {{"rows", m.pairs},        {"plain", m.plain}, {"theta_10", m.at_ten}, {"theta_to_20", m.to_twenty},
          {"weighted", m.weighted}, {"l2", m.l2}};
}

/// Metrics in percent; a dash where no reading counts.
std::string percent(double fraction) {
  return std::isfinite(fraction) ? fmt::format("{:.1f}", 100.0 * fraction) : "-";
}

std::string metrics_table(const GoniometerResult& result) {
  std::string text = fmt::format("{:<14}{:<11}{:>6}{:>9}{:>12}{:>13}{:>10}{:>7}\n", "against", "column", "rows",
                                 "plain", "theta = 10", "theta <= 20", "weighted", "L2");
  for (const auto& [kind, kind_name] : kKinds) {
    for (const auto& [column, name] : kColumns) {
      const LuminanceMetrics m = goniometer_metrics(result, column, kind);
      if (m.pairs == 0) continue;
      if (column == GoniometerColumn::traced && result.photons == 0) continue;
      text += fmt::format("{:<14}{:<11}{:>6}{:>9}{:>12}{:>13}{:>10}{:>7}\n", kind_name, name, m.pairs, percent(m.plain),
                          percent(m.at_ten), percent(m.to_twenty), percent(m.weighted), percent(m.l2));
    }
  }
  return text;
}

std::string measured_text(const GoniometerResult& result) {
  return "\nSimulated (s) against measured (m) luminance, percent: plain = RMS of (s-m)/m, also at theta = 10 and\n"
         "theta <= 20 degrees; weighted = that with weight m; L2 = sqrt(sum (s-m)^2 / sum m^2)\n" +
         metrics_table(result) +
         "published = simulated column of the measured file; table = the film's table, interpolated;\n"
         "film = the film as the tracer evaluates it; traced = photons, with their noise (standard errors in the "
         "tables)\n" +
         kFittedCaveat + "\n";
}

}  // namespace

const char* const kFittedCaveat =
    "Note: the DBEF data (configs/data/dbef.csv and the default model) were fitted to these very measurements. Their\n"
    "agreement shows a good fit, not a prediction; the published column is a prediction from another measurement.";

std::string goniometer_csv(const GoniometerSpec& spec, const GoniometerResult& result, ScatterKind kind) {
  std::string text = fmt::format(
      "# {} by a virtual goniometer: luminance in cd/m2, angles in degrees; illuminance {:g} lx, sigma {:g} deg, "
      "acceptance half-angle {:g} deg, filter k1 + k2 = {:g}\n"
      "psi_deg,theta_deg,illumination,measured_cd_m2,published_cd_m2,table_cd_m2,film_cd_m2,traced_cd_m2,"
      "traced_se_cd_m2,expected_hits,hits,z\n",
      kind == ScatterKind::reflection ? "Reflection" : "Transmission", spec.illuminance, degrees(spec.sigma),
      degrees(spec.acceptance), spec.filter.k1 + spec.filter.k2);
  const bool traced = result.photons > 0;
  const auto if_traced = [&](double value) { return traced ? std::optional(value) : std::nullopt; };
  for (const GoniometerRow& row : result.rows) {
    if (row.kind != kind) continue;
    text += fmt::format("{:g},{:g},{},{},{},{},{},{},{},{},{},{}\n", degrees(row.setting.psi),
                        degrees(row.setting.theta), illumination_name(row.setting), entry(given(row.setting.measured)),
                        entry(given(row.setting.published)), entry(row.table), entry(row.film),
                        entry(if_traced(row.traced.value)), entry(if_traced(row.traced.se)),
                        entry(if_traced(row.expected_hits)), entry(if_traced(row.hits)), entry(if_traced(row.z)));
  }
  return text;
}

std::string goniometer_json(const GoniometerSpec& spec, const GoniometerResult& result, const GoniometerFacts& facts) {
  Json json{{"format", "evenglow-goniometer/1"},
            {"version", core::version()},
            {"title", facts.title},
            {"command", facts.command},
            {"run_file_sha256", facts.run_file_sha256},
            {"seed", facts.seed},
            {"photons_per_setting", facts.photons_per_setting},
            {"photons", result.photons}};
  json["setup"] = {{"illuminance_lx", spec.illuminance},
                   {"sigma_deg", degrees(spec.sigma)},
                   {"acceptance_deg", degrees(spec.acceptance)},
                   {"k1", spec.filter.k1},
                   {"k2", spec.filter.k2},
                   {"offset_reflection_deg", degrees(spec.offset_reflection)},
                   {"offset_transmission_deg", degrees(spec.offset_transmission)}};
  if (result.photons > 0) {
    json["agreement"] = {{"chi_square", result.agreement.chi_square},
                         {"degrees_of_freedom", result.agreement.rows},
                         {"chi_square_per_degree", result.agreement.per_degree()},
                         {"largest_z", result.agreement.largest_z}};
  }
  if (!spec.measured.empty()) {
    Json metrics = Json::object();
    for (const auto& [kind, kind_name] : kKinds) {
      for (const auto& [column, name] : kColumns) {
        if (column == GoniometerColumn::traced && result.photons == 0) continue;
        const LuminanceMetrics m = goniometer_metrics(result, column, kind);
        if (m.pairs > 0) metrics[kind_name][name] = metrics_json(m);
      }
    }
    json["metrics"] = std::move(metrics);
    json["caveat"] = kFittedCaveat;
  }
  json["remarks"] = spec.film.remarks;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string goniometer_summary(const GoniometerSpec& spec, const GoniometerResult& result) {
  std::string text;
  for (const std::string& remark : spec.film.remarks) text += "film: " + remark + "\n";
  if (result.photons > 0) {
    const auto& a = result.agreement;
    text += fmt::format(
        "traced against evaluated: {:.3g} photons, {} of {} rows with at least 20 expected hits: chi-square / degrees "
        "of "
        "freedom {:.1f} / {} = {:.2f}, largest |z| {:.2f}\n",
        static_cast<double>(result.photons), a.rows, result.rows.size(), a.chi_square, a.rows, a.per_degree(),
        a.largest_z);
  }
  if (!spec.measured.empty()) text += measured_text(result);
  return text;
}

}  // namespace evenglow::app

#include "app/lobe_fit_text.h"

#include <cmath>

#include <fmt/format.h>

#include "core/base/units.h"

namespace evenglow::app {
namespace {

using tracer::FilmLight;
using tracer::LuminanceMetrics;
using tracer::ScatterKind;

std::string metrics_line(const char* name, const LuminanceMetrics& m) {
  const auto percent = [](double x) { return std::isfinite(x) ? fmt::format("{:.1f}", 100.0 * x) : std::string("-"); };
  return fmt::format("  {:<14}{:>6}{:>9}{:>12}{:>13}{:>10}{:>7}\n", name, m.pairs, percent(m.plain), percent(m.at_ten),
                     percent(m.to_twenty), percent(m.weighted), percent(m.l2));
}

std::string metrics_text(const LuminanceMetrics& reflection, const LuminanceMetrics& transmission) {
  return fmt::format("  {:<14}{:>6}{:>9}{:>12}{:>13}{:>10}{:>7}\n", "percent", "rows", "plain", "theta = 10",
                     "theta <= 20", "weighted", "L2") +
         metrics_line("reflection", reflection) + metrics_line("transmission", transmission);
}

/// Path of `file` as written in a run file at `run_file`, in quotes, as any name may be; absolute where a relative one
/// would climb higher than a run file may name.
std::string yaml_path(const std::filesystem::path& file, const std::filesystem::path& run_file) {
  const auto folder = std::filesystem::absolute(run_file).parent_path();
  const auto absolute = std::filesystem::absolute(file).lexically_normal();
  const std::string relative = absolute.lexically_relative(folder.lexically_normal()).string();
  const std::string name = relative.starts_with("../../") ? absolute.string() : relative;
  std::string text = "\"";
  for (const char c : name) text += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
  return text + "\"";
}

}  // namespace

std::string fit_summary(const tracer::LobeFit& fit, std::size_t readings) {
  std::string text = fmt::format("{} readings, {} parameters ({} free); {} after {} steps\n", readings,
                                 fit.values.size(), readings - static_cast<std::size_t>(fit.degrees_of_freedom),
                                 fit.converged ? "converged" : "NOT converged", fit.iterations);
  for (const auto& value : fit.values) {
    text += fmt::format("  {:<26}{:>12.5g} ± {:<10.2g}\n", value.key, value.value, value.se);
  }
  text += fmt::format("chi-square / degrees of freedom: {:.1f} / {} = {:.2f} (1 if the errors are those assumed)\n",
                      fit.chi_square, fit.degrees_of_freedom, fit.chi_square / fit.degrees_of_freedom);
  for (const std::string& remark : fit.remarks) text += "remark: " + remark + "\n";
  return text + "fitted against measured readings:\n" + metrics_text(fit.reflection, fit.transmission);
}

std::string validation_summary(const tracer::CrossValidation& validation) {
  return fmt::format(
             "{}-fold cross-validation, each reading predicted by a fit without it (chi-square per reading {:.2f}):\n",
             validation.folds, validation.chi_square) +
         metrics_text(validation.reflection, validation.transmission);
}

std::string hemispherical_summary(const tracer::LobeModel& film) {
  std::string text =
      fmt::format("  {:<10}{:>8}{:>8}{:>8}{:>8}\n", "sigma_deg", "T_pass", "R_pass", "T_block", "R_block");
  for (const int sigma : {0, 30, 45, 60}) {
    const auto rho = [&](ScatterKind kind, FilmLight light) {
      return film.hemispherical(kind, light, sigma * core::kRadPerDeg);
    };
    text +=
        fmt::format("  {:<10}{:>8.3f}{:>8.3f}{:>8.3f}{:>8.3f}\n", sigma,
                    rho(ScatterKind::transmission, FilmLight::pass), rho(ScatterKind::reflection, FilmLight::pass),
                    rho(ScatterKind::transmission, FilmLight::block), rho(ScatterKind::reflection, FilmLight::block));
  }
  return "hemispherical reflectance and transmittance (oblique incidence is an assumption of the model):\n" + text;
}

std::string fitted_run_file(const tracer::LobeFit& fit, const std::filesystem::path& path,
                            const std::filesystem::path& reflection, const std::filesystem::path& transmission) {
  std::string model;
  for (const tracer::LobeParameter& p : tracer::lobe_parameters()) {
    std::string error;
    for (const auto& value : fit.values) {
      if (value.key == p.key) error = fmt::format("  # ± {:.2g}", value.se);
    }
    model += fmt::format("      {}: {:.8g}{}\n", p.key, fit.parameters.*p.member, error);
  }
  return fmt::format(
      "# Fitted by `evenglow film fit`; errors are standard errors. `model` is what a film of kind dbef takes.\n"
      "evenglow: 1\n"
      "title: fitted film against the readings it was fitted to\n"
      "goniometer:\n"
      "  film:\n"
      "    kind: dbef\n"
      "    model:\n{}"
      "  lamp: {{illuminance_lx: {:.8g}}}\n"
      "  filter: {{k1: {:.8g}, k2: 0, offset_reflection_deg: {:.6g}, offset_transmission_deg: {:.6g}}}\n"
      "  measured:\n"
      "    reflection: {}\n"
      "    transmission: {}\n",
      model, fit.parameters.e0, fit.setup.throughput, fit.setup.offset_reflection / core::kRadPerDeg,
      fit.setup.offset_transmission / core::kRadPerDeg, yaml_path(reflection, path), yaml_path(transmission, path));
}

}  // namespace evenglow::app

#include "tracer/polarized_bsdf/reconstruction_writer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr const char* kNodeColumns = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm";

void add_node(std::string& text, const FilmNode& n) {
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}", n.kind == ScatterKind::reflection ? "BRDF" : "BTDF",
                 n.psi_deg, n.sigma_deg, n.phi_deg, n.theta_deg, n.lambda_nm);
}

void add(std::string& text, double value) {
  fmt::format_to(std::back_inserter(text), ",{:.12g}", value + 0.0);
}
void add_se(std::string& text, double value) {
  fmt::format_to(std::back_inserter(text), ",{:.4g}", value);
}

const char* frames(const Reconstruction& r) {
  return r.angles == AngleOrigin::film ? "frames turned to the film axis in both channels"
                                       : "frames e1, e2 of the incident and of the outgoing ray";
}

}  // namespace

std::string table_text(const Reconstruction& r) {
  std::string text = fmt::format(
      "# Polarized BSDF reconstructed from readings behind polarizers ({}). angles in degrees, wavelength in nm, "
      "tau_min "
      "and tau_max in 1/sr (luminance / illuminance), delta in degrees from the film axis",
      r.general ? "in both channels" : "in the illumination channel");
  if (r.has_errors) text += "; _se: standard errors";
  text += fmt::format("\n{},tau_min,tau_max,delta_deg", kNodeColumns);
  if (r.has_errors) text += ",tau_min_se,tau_max_se,delta_se_deg";
  if (r.general) text += ",kappa";
  text += '\n';
  for (const NodeResult& node : r.nodes) {
    const DiattenuatorValues& v = node.values;
    add_node(text, node.node);
    add(text, v.tau_min);
    add(text, v.tau_max);
    add(text, std::round(v.delta / core::kRadPerDeg * 1e10) * 1e-10);  // no rounding noise about 0
    if (r.has_errors) {
      add_se(text, v.tau_min_se);
      add_se(text, v.tau_max_se);
      add_se(text, v.delta_se / core::kRadPerDeg);
    }
    if (r.general) add(text, node.kappa);
    text += '\n';
  }
  return text;
}

std::string mueller_text(const Reconstruction& r) {
  std::string text = fmt::format(
      "# Mueller matrices of a film, {}; tangential count. angles in degrees, wavelength in nm, entries, eigenvalue "
      "and "
      "their standard errors (_se) in 1/sr\n{}",
      frames(r), kNodeColumns);
  for (const char* ending : {"", "_se"}) {
    for (int k = 0; k < 16; ++k) text += fmt::format(",m{}{}{}", k / 4, k % 4, ending);
  }
  text += ",chi_square,degrees_of_freedom,chi_square_increase,least_eigenvalue,least_eigenvalue_se,rest\n";
  for (const NodeResult& node : r.nodes) {
    const MuellerFit& fit = node.mueller.value();
    add_node(text, node.node);
    for (int k = 0; k < 16; ++k) add(text, fit.M(k / 4, k % 4));
    for (int k = 0; k < 16; ++k) add_se(text, std::sqrt(std::max(0.0, fit.covariance(k, k))));
    fmt::format_to(std::back_inserter(text), ",{:.6g},{},{:.6g},{:.6g},{:.4g},{:.4g}\n", fit.chi_square,
                   fit.degrees_of_freedom, fit.chi_square_increase, fit.least_eigenvalue, fit.least_eigenvalue_se,
                   node.rest);
  }
  return text;
}

std::string covariance_text(const Reconstruction& r) {
  std::string text = fmt::format(
      "# Covariances of the entries of the Mueller matrices, upper triangles. angles in degrees, wavelength in nm, "
      "covariances in (1/sr)^2\n{}",
      kNodeColumns);
  for (int i = 0; i < 16; ++i) {
    for (int j = i; j < 16; ++j) text += fmt::format(",c_{}{}_{}{}", i / 4, i % 4, j / 4, j % 4);
  }
  text += '\n';
  for (const NodeResult& node : r.nodes) {
    add_node(text, node.node);
    for (int i = 0; i < 16; ++i) {
      for (int j = i; j < 16; ++j) fmt::format_to(std::back_inserter(text), ",{:.6g}", node.mueller->covariance(i, j));
    }
    text += '\n';
  }
  return text;
}

}  // namespace evenglow::tracer

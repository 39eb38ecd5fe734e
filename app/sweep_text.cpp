#include "app/sweep_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/sweep_options.h"
#include "core/base/units.h"
#include "core/config/message_text.h"

namespace evenglow::app {
namespace {

using tracer::SweepRow;

constexpr std::size_t kMostTableRows = 60;
constexpr std::ptrdiff_t kMostHazeLines = 10;

/// Degrees without the rounding of the way to radians and back.
double degrees(double rad) {
  return std::round(rad / core::kRadPerDeg * 1e9) / 1e9;
}

constexpr std::array<core::Estimate SweepRow::*, 7> kShares{&SweepRow::reflectance,
                                                            &SweepRow::transmittance,
                                                            &SweepRow::absorbed,
                                                            &SweepRow::specular_reflectance,
                                                            &SweepRow::specular_transmittance,
                                                            &SweepRow::scattered_reflectance,
                                                            &SweepRow::scattered_transmittance};

std::string share_text(const core::Estimate& share, bool with_se) {
  if (!with_se) return fmt::format("{:.4f}", share.value);
  return fmt::format("{:.4f} ±{:.4f}", share.value, share.se);
}

/// Rounding about zero is zero.
double clean(double x) {
  return std::abs(x) < 1e-12 ? 0.0 : x;
}

std::string state_text(const SweepRow& row) {
  if (!row.transmitted) return fmt::format(" {:>7} {:>7} {:>7} {:>7}", "-", "-", "-", "-");
  const auto& s = *row.transmitted;
  return fmt::format(" {:>7.4f} {:>7.4f} {:>7.4f} {:>7.4f}", s.degree, clean(s.q), clean(s.u), clean(s.v));
}

/// One line for each wavelength at normal incidence, of the first light of the list there (natural, if it is asked
/// for).
std::string haze_text(const std::vector<SweepRow>& rows) {
  std::string text;
  double last = 0.0;
  for (const SweepRow& row : rows) {
    if (!row.haze || row.wavelength == last) continue;
    last = row.wavelength;
    text +=
        fmt::format("haze (ASTM D1003: beyond 2.5 degrees, of the transmitted light) at {:g} nm, light {}: {:.2f} %",
                    row.wavelength, name_of(row.light), 100.0 * row.haze->value);
    text += row.haze->se > 0.0 ? fmt::format(" ±{:.2f} %\n", 100.0 * row.haze->se) : "\n";
    if (std::count(text.begin(), text.end(), '\n') == kMostHazeLines) return text + "...\n";
  }
  return text;
}

/// The range over all rows of the facets that a photon meets in a prism film; empty for other films.
std::string facets_text(const std::vector<SweepRow>& rows) {
  const core::Estimate* fewest = nullptr;
  const core::Estimate* most = nullptr;
  for (const SweepRow& row : rows) {
    if (!row.facets) continue;
    if (fewest == nullptr || row.facets->value < fewest->value) fewest = &*row.facets;
    if (most == nullptr || row.facets->value > most->value) most = &*row.facets;
  }
  if (fewest == nullptr) return "";
  return fmt::format("facets of the prisms that a photon meets, on average: {:.3f} ±{:.3f} to {:.3f} ±{:.3f}\n",
                     fewest->value, fewest->se, most->value, most->se);
}

}  // namespace

std::string sweep_csv(const std::vector<SweepRow>& rows, const std::string& what, bool from_above) {
  std::string text = fmt::format(
      "# {}, lit from {}: angles in degrees, wavelength in nm, shares of the incident power (1) with standard errors "
      "(se; 0: exact); dop, q, u, v: of the straight light, per its power, e1 in the plane of incidence; "
      "haze: at sigma 0, share of the transmitted light that deviates by more than 2.5 degrees; "
      "facets: of a prism film, met by a photon\n"
      "wavelength_nm,azimuth_deg,polarization,sigma_deg,reflectance,reflectance_se,transmittance,transmittance_se,"
      "absorbed,absorbed_se,reflectance_specular,reflectance_specular_se,transmittance_specular,"
      "transmittance_specular_se,reflectance_scattered,reflectance_scattered_se,transmittance_scattered,"
      "transmittance_scattered_se,dop,q,u,v,haze,haze_se,facets,facets_se\n",
      core::one_line(what), from_above ? "above" : "below");
  for (const SweepRow& row : rows) {
    text +=
        fmt::format("{:g},{:g},{},{:g}", row.wavelength, degrees(row.azimuth), name_of(row.light), degrees(row.sigma));
    for (const auto share : kShares) text += fmt::format(",{:.8g},{:.4g}", (row.*share).value, (row.*share).se);
    if (row.transmitted) {
      const auto& s = *row.transmitted;
      text += fmt::format(",{:.8g},{:.8g},{:.8g},{:.8g}", s.degree, clean(s.q), clean(s.u), clean(s.v));
    } else {
      text += ",,,,";
    }
    for (const auto& extra : {row.haze, row.facets}) {
      text += extra ? fmt::format(",{:.8g},{:.4g}", extra->value, extra->se) : std::string(",,");
    }
    text += '\n';
  }
  return text;
}

std::string sweep_table(const std::vector<SweepRow>& rows) {
  const bool counted = std::any_of(rows.begin(), rows.end(), [](const SweepRow& r) {
    return r.transmittance.se + r.reflectance.se + r.absorbed.se > 0.0;
  });
  const int width = counted ? 15 : 8;
  std::string text = fmt::format(
      "{:>9} {:>7} {:>5} {:>6} | {:>{}} {:>{}} {:>{}} | {:>8} {:>8} {:>7} {:>7} {:>7} {:>7}\n", "lambda_nm", "azimuth",
      "light", "sigma", "R", width, "T", width, "absorbed", width, "R spec", "T spec", "DOP", "q", "u", "v");
  for (std::size_t i = 0; i < std::min(rows.size(), kMostTableRows); ++i) {
    const SweepRow& row = rows[i];
    text +=
        fmt::format("{:>9.5g} {:>7.4g} {:>5} {:>6.4g} | {:>{}} {:>{}} {:>{}} | {:>8.4f} {:>8.4f}{}\n", row.wavelength,
                    degrees(row.azimuth), name_of(row.light), degrees(row.sigma), share_text(row.reflectance, counted),
                    width, share_text(row.transmittance, counted), width, share_text(row.absorbed, counted), width,
                    row.specular_reflectance.value, row.specular_transmittance.value, state_text(row));
  }
  if (rows.size() > kMostTableRows) {
    text += fmt::format("... and {} rows more (-o FILE.csv writes all)\n", rows.size() - kMostTableRows);
  }
  text +=
      "R, T: shares into the hemisphere; spec: mirrored, straight; DOP, q, u, v: straight light, degree of "
      "polarization and Stokes "
      "vector per power (e1 in the plane of incidence); ";
  text += counted ? "± 1 standard error\n" : "exact\n";
  return text + haze_text(rows) + facets_text(rows);
}

}  // namespace evenglow::app

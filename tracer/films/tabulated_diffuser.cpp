#include "tracer/films/tabulated_diffuser.h"

#include <fmt/format.h>

#include "tracer/films/diffuser.h"

namespace evenglow::tracer {
namespace {

constexpr double kWavelength = 550.0;  // nm; the only one of the table

/// Natural light along k: the table does not see polarization, so it stands for all.
core::StokesVector natural(const core::StokesVector& light) {
  return core::StokesVector::unpolarized(light.I, light.frame);
}

TabulatedDbef lobes_of(const BsdfTable& table, const std::optional<TabulatedDiffuser::Totals>& totals) {
  if (!totals) return {table, kWavelength, nullptr, 0.0};
  const double T = totals->transmittance, R = totals->reflectance;
  const auto everywhere = HemisphericalTable::parse(
      fmt::format("sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block\n"
                  "0,{0},{1},{0},{1}\n",
                  T, R),
      "totals");
  return {table, kWavelength, &everywhere, 0.0};
}

}  // namespace

TabulatedDiffuser::TabulatedDiffuser(const BsdfTable& table, const std::optional<Totals>& totals, double depolarization)
    : lobes_(lobes_of(table, totals)), depolarization_(depolarization) {}

std::optional<BsdfSample> TabulatedDiffuser::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const auto drawn = lobes_.sample(natural(incident), rng);
  if (!drawn) return std::nullopt;
  return BsdfSample{scattered_light(incident, drawn->light.frame.k, depolarization_), false};
}

core::StokesVector TabulatedDiffuser::evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const {
  const double f = lobes_.evaluate(natural(incident), k_out).I / incident.I;
  return scattered_light(incident, k_out, depolarization_).scaled(f);
}

double TabulatedDiffuser::hemispherical(const core::Vec3& k, ScatterKind kind) const {
  return lobes_.hemispherical(core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k)), kind);
}

std::vector<std::string> TabulatedDiffuser::remarks() const {
  std::vector<std::string> kept;
  for (const std::string& remark : lobes_.remarks()) {
    // That it does not tell two polarizations apart is no news of an unpolarized table.
    if (remark.find("pass from block") == std::string::npos) kept.push_back(remark);
  }
  for (std::string& remark : kept) {
    const std::string words = "the hemispherical table";
    if (const auto at = remark.find(words); at != std::string::npos) {
      remark.replace(at, words.size(), "transmittance and reflectance");
    }
  }
  return kept;
}

}  // namespace evenglow::tracer

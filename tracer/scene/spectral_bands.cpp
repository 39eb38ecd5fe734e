#include "tracer/scene/spectral_bands.h"

#include <algorithm>
#include <map>

#include "core/light/cie_1931.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

constexpr double kDefaultWavelength = 550.0;

/// A line of a source: tristimulus values as shares of the source's Y, and odds among the source's photons.
struct Line {
  double wavelength = 0.0;
  Vec3 xyz;
  double odds = 0.0;
};

std::vector<Line> lines_of(const Spectrum& spectrum, bool color) {
  const Vec3 whole = spectrum.xyz();
  std::vector<Line> lines;
  for (std::size_t i = 0; i < spectrum.wavelength.size(); ++i) {
    const Vec3 xyz = spectrum.power[i] * core::color_matching(spectrum.wavelength[i]) / whole.y();
    const double luminous = xyz.y();
    const double odds = color ? 0.5 * luminous + 0.5 * xyz.sum() * whole.y() / whole.sum() : luminous;
    if (odds > 0.0) lines.push_back({spectrum.wavelength[i], xyz, odds});
  }
  return lines;
}

/// From the wavelength of a line to its band: cuts where the odds of all sources together pass multiples of 1 / count.
std::map<double, std::size_t> bands_of(const std::map<double, double>& odds, double total, std::size_t count) {
  std::map<double, std::size_t> bands;
  double before = 0.0;
  std::size_t used = 0, slot = 0;
  bool first = true;
  for (const auto& [wavelength, odds_here] : odds) {
    const double middle = (before + 0.5 * odds_here) / total;
    const auto here = std::min(static_cast<std::size_t>(middle * static_cast<double>(count)), count - 1);
    if (!first && (here != slot || odds.size() <= count)) ++used;
    first = false;
    slot = here;
    bands[wavelength] = used;
    before += odds_here;
  }
  return bands;
}

}  // namespace

SpectralBands::SpectralBands(const std::vector<Spectrum>& spectra, const std::vector<double>& fluxes, std::size_t count,
                             bool color) {
  std::vector<std::vector<Line>> lines;
  std::map<double, double> odds;
  double flux = 0.0;
  for (std::size_t s = 0; s < spectra.size(); ++s) {
    lines.push_back(lines_of(spectra[s], color));
    for (const Line& line : lines.back()) odds[line.wavelength] += fluxes[s] * line.odds;
    flux += fluxes[s];
  }
  if (odds.empty()) {
    wavelengths_ = {kDefaultWavelength};
    return;
  }
  const auto band_of = bands_of(odds, flux, std::max<std::size_t>(count, 1));
  wavelengths_.assign(band_of.rbegin()->second + 1, 0.0);
  std::vector<double> weights(wavelengths_.size(), 0.0);
  for (const auto& [wavelength, odds_here] : odds) {
    wavelengths_[band_of.at(wavelength)] += odds_here * wavelength;
    weights[band_of.at(wavelength)] += odds_here;
  }
  for (std::size_t b = 0; b < wavelengths_.size(); ++b) wavelengths_[b] /= weights[b];

  mean_ = Vec3::Zero();
  for (std::size_t s = 0; s < lines.size(); ++s) {
    std::vector<double> share(size(), 0.0);
    std::vector<Vec3> xyz(size(), Vec3::Zero());
    for (const Line& line : lines[s]) {
      share[band_of.at(line.wavelength)] += line.odds;
      xyz[band_of.at(line.wavelength)] += line.xyz;
      mean_ += fluxes[s] / flux * line.xyz;
    }
    sources_.emplace_back();
    double up_to = 0.0;
    for (std::size_t b = 0; b < size(); ++b) {
      if (share[b] <= 0.0) continue;
      sources_.back().push_back({up_to += share[b], b, xyz[b] / share[b]});
    }
  }
}

SpectralBands::Choice SpectralBands::choose(std::size_t source, double uniform) const {
  const std::vector<Share>& shares = sources_[source];
  const auto it = std::upper_bound(shares.begin(), shares.end() - 1, uniform,
                                   [](double u, const Share& share) { return u < share.up_to; });
  return {it->band, it->weight};
}

}  // namespace evenglow::tracer

#include "tracer/sources/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/config/csv_numbers.h"
#include "core/light/cie_1931.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

constexpr double kPeak = 550.0;  // nm
constexpr Range kVisible = Range::closed(core::kShortestVisible, core::kLongestVisible);
constexpr Range kWidth = Range::closed(1, 400);

/// One line a nanometer of a spectral power per nanometer.
Spectrum sampled(const std::function<double(double)>& power) {
  Spectrum spectrum;
  for (double nm = core::kShortestVisible; nm <= core::kLongestVisible; nm += 1.0) {
    const double p = power(nm);
    if (p <= 0.0) continue;
    spectrum.wavelength.push_back(nm);
    spectrum.power.push_back(p);
  }
  return spectrum;
}

/// Integral of the table, linear between its rows, from `low` to `high` (nm) within the rows `i` and i + 1.
double piece(const core::CsvNumbers& rows, std::size_t i, double low, double high) {
  const double x0 = rows.value(i, 0), x1 = rows.value(i + 1, 0);
  const double from = std::max(low, x0), to = std::min(high, x1);
  if (from >= to) return 0.0;
  const double t = (0.5 * (from + to) - x0) / (x1 - x0);
  return (to - from) * std::lerp(rows.value(i, 1), rows.value(i + 1, 1), t);
}

/// One line a nanometer with the power of the table within half a nanometer of it, so that no narrow line of a finely
/// sampled spectrum slips through.
Spectrum binned(const core::CsvNumbers& rows) {
  std::size_t first = 0;
  return sampled([&](double nm) {
    const double low = nm - 0.5, high = nm + 0.5;
    while (first + 2 < rows.rows() && rows.value(first + 1, 0) <= low) ++first;
    double sum = 0.0;
    for (std::size_t i = first; i + 1 < rows.rows() && rows.value(i, 0) < high; ++i) sum += piece(rows, i, low, high);
    return sum;
  });
}

Spectrum read_table(const std::filesystem::path& file) {
  constexpr std::array<core::Range, 2> kRanges{kVisible, Range::closed(0, 1e12)};
  const std::array<core::CsvColumn, 2> columns{
      core::CsvColumn{"wavelength_nm", "a wavelength in [380, 780] nm", kRanges[0].min, kRanges[0].max},
      core::CsvColumn{"power", "a number >= 0", kRanges[1].min, kRanges[1].max}};
  const core::CsvNumbers rows = core::CsvNumbers::read(file, columns);
  for (std::size_t i = 1; i < rows.rows(); ++i) {
    if (rows.value(i, 0) > rows.value(i - 1, 0)) continue;
    throw core::ConfigError(core::Fault{file.string(), rows.line(i), 0, "wavelength_nm",
                                        fmt::format("must be larger than that of the row before ({:g}), got {:g}",
                                                    rows.value(i - 1, 0), rows.value(i, 0))});
  }
  if (rows.rows() < 2) {
    throw core::ConfigError(
        core::Fault{file.string(), 0, 0, "", "must hold two rows at least, power per nm between them, got one"});
  }
  Spectrum spectrum = binned(rows);
  if (!(spectrum.xyz().y() > 0.0)) {
    throw core::ConfigError(core::Fault{file.string(), 0, 0, "power", "must hold some visible light, got none"});
  }
  return spectrum;
}

/// Area of a peak of `led_peak` (nm), so that powers can be given.
double area(double center, double fwhm) {
  double sum = 0.0;
  for (double nm = core::kShortestVisible; nm <= core::kLongestVisible; nm += 1.0) sum += led_peak(nm, center, fwhm);
  return sum;
}

/// Power per nm of a phosphor: a Gaussian against 1 / wavelength, as its band is broadened in energy, with the peak and
/// the full width at half maximum (nm) of what a spectrometer shows: 1/center -+ width/2 are `fwhm` apart.
double phosphor_band(double wavelength, double center, double fwhm) {
  const double width = 2.0 * fwhm / (center * (center + std::hypot(center, fwhm)));
  const double x = (1.0 / wavelength - 1.0 / center) / width;
  return std::exp(-4.0 * std::log(2.0) * x * x);
}

Spectrum read_white_led(const ConfigNode& node) {
  const double blue = node.number({"blue_nm", "peak of the blue chip", Range::closed(400, 500), 450.0});
  const double blue_fwhm = node.number({"blue_fwhm_nm", "its full width at half maximum", kWidth, 20.0});
  const double phosphor = node.number({"phosphor_nm", "peak of the phosphor", Range::closed(480, 680), 560.0});
  const double phosphor_fwhm =
      node.number({"phosphor_fwhm_nm", "its full width at half maximum", Range::closed(1, 300), 120.0});
  const double share =
      node.number({"blue_share", "share of the radiant power that the chip's peak has", Range::closed(0, 1), 0.3});
  double band = 0.0;
  for (double nm = core::kShortestVisible; nm <= core::kLongestVisible; nm += 1.0) {
    band += phosphor_band(nm, phosphor, phosphor_fwhm);
  }
  const double chip = area(blue, blue_fwhm);
  return sampled([&](double nm) {
    return share / chip * led_peak(nm, blue, blue_fwhm) +
           (1.0 - share) / band * phosphor_band(nm, phosphor, phosphor_fwhm);
  });
}

Spectrum read_rgb(const ConfigNode& node) {
  const std::vector<double> peaks =
      node.numbers({"peaks_nm", "centers of the three peaks", Range::closed(400, 700), 3, 3, {{630.0, 525.0, 455.0}}});
  const std::vector<double> widths =
      node.numbers({"fwhm_nm", "full widths at half maximum", kWidth, 3, 3, {{20.0, 32.0, 22.0}}});
  std::vector<double> powers =
      node.numbers({"powers", "relative radiant powers of the peaks", Range::closed(0, 1e6), 3, 3, {{1.0, 1.0, 1.0}}});
  if (powers.size() == 3 && powers[0] + powers[1] + powers[2] <= 0.0) {
    node.fault_at("powers", "must not all be 0, got [0, 0, 0]");
    powers = {1.0, 1.0, 1.0};
  }
  if (peaks.size() != 3 || widths.size() != 3 || powers.size() != 3) return monochromatic(kPeak);
  return sampled([&](double nm) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += powers[i] / area(peaks[i], widths[i]) * led_peak(nm, peaks[i], widths[i]);
    return sum;
  });
}

}  // namespace

core::Vec3 Spectrum::xyz() const {
  core::Vec3 sum = core::Vec3::Zero();
  for (std::size_t i = 0; i < wavelength.size(); ++i) sum += power[i] * core::color_matching(wavelength[i]);
  return sum;
}

Spectrum monochromatic(double wavelength) {
  return {{wavelength}, {1.0}};
}

double led_peak(double wavelength, double center, double fwhm) {
  // (g + 2 g^5) / 3 is one half where g = g0; its half width is sqrt(-ln g0) times the width of g.
  constexpr double kHalf = 0.8086092632090855;  // g0 + 2 g0^5 = 3/2
  const double width = 0.5 * fwhm / std::sqrt(-std::log(kHalf));
  const double x = (wavelength - center) / width;
  const double g = std::exp(-x * x);
  return (g + 2.0 * std::pow(g, 5)) / 3.0;
}

Spectrum read_spectrum(const ConfigNode& source) {
  const ConfigNode node = source.map("spectrum", "spectral power of the source; default: light of 550 nm");
  if (!node.present()) return monochromatic(kPeak);
  const auto kind =
      node.kind({"kind", "which spectrum", {"monochromatic", "table", "white_led", "rgb", "equal_energy"}, {}});
  if (!kind) return monochromatic(kPeak);
  if (*kind == "table") {
    const auto file = node.file({"file", "CSV of wavelength_nm and power, relative power per nm", {}});
    if (file.empty()) return monochromatic(kPeak);
    return node.guarded("file", [&] { return read_table(file); }).value_or(monochromatic(kPeak));
  }
  if (*kind == "white_led") return read_white_led(node);
  if (*kind == "rgb") return read_rgb(node);
  if (*kind == "equal_energy") return sampled([](double) { return 1.0; });
  return monochromatic(node.number({"wavelength_nm", "of the light", kVisible, kPeak}));
}

}  // namespace evenglow::tracer

#include "tracer/films/retarder.h"

#include <array>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "core/base/units.h"
#include "tracer/films/film_keys.h"

namespace evenglow::tracer {
namespace {

using core::Range;

constexpr double kSurfaceWavelength = 550.0;  // nm, of Film::surface

/// Retardance in nm at the design wavelength from the one key that gives it.
double read_retardance(const core::ConfigNode& node, double design_wavelength) {
  const std::array<const char*, 3> keys{"plate", "retardance_nm", "retardance_deg"};
  const char* given = nullptr;
  for (const char* key : keys) {
    if (!node.has(key)) continue;
    if (given) node.fault_at(key, fmt::format("must not stand beside {}: one of the two gives the retardance", given));
    given = key;
  }
  // Every key is read, so that none of two is called unknown.
  const std::string plate =
      node.choice({"plate", "retardance at the design wavelength", {"quarter", "half"}, "quarter"});
  const auto nm = node.optional_number({"retardance_nm", "retardance at the design wavelength", Range::positive(1e5)});
  const auto phase =
      node.optional_number({"retardance_deg", "retardance at the design wavelength", Range::positive(36000)});
  if (nm) return *nm;
  if (phase) return *phase / (2.0 * core::kPi) * design_wavelength;
  return (plate == "half" ? 0.5 : 0.25) * design_wavelength;
}

double cauchy(double b, double wavelength) {
  return 1.0 + b / (wavelength * wavelength);
}

}  // namespace

double RetardanceDispersion::factor(double wavelength_nm) const {
  // (1 + B / 450^2) = ratio (1 + B / 550^2).
  const double b = (ratio - 1.0) / (1.0 / (450.0 * 450.0) - ratio / (550.0 * 550.0));
  return cauchy(b, wavelength_nm) / cauchy(b, design_wavelength);
}

double retardance_phase(double retardance_nm, double wavelength_nm) {
  return 2.0 * core::kPi * retardance_nm / wavelength_nm;
}

WavePlate::Spec read_wave_plate(const core::ConfigNode& node, const WavePlate::Spec& defaults) {
  WavePlate::Spec spec = defaults;
  spec.fast_axis = axis_of(node, "fast axis, counted from +x towards +y");
  spec.index = node.number({"refractive_index", "ordinary index", Range::closed(1.0001, 4), defaults.index});
  spec.birefringence =
      node.number({"birefringence", "extraordinary less ordinary index; above 0: the optic axis is the slow axis",
                   Range::closed(-0.3, 0.3), defaults.birefringence});
  if (spec.index + spec.birefringence < 1.0001) {
    node.fault_at("birefringence", fmt::format("must be at least 1.0001 - refractive_index = {:g}, got {:g}",
                                               1.0001 - spec.index, spec.birefringence));
    spec.birefringence = 0.0;
  }
  spec.faces = node.choice({"faces",
                            "coated: no reflection; fresnel: smooth faces of the index",
                            {"coated", "fresnel"},
                            defaults.faces ? "fresnel" : "coated"}) == "fresnel";
  return spec;
}

Film make_retarder(const core::ConfigNode& node) {
  Film film = film_of("retarder", node);
  const WavePlate::Spec plate = read_wave_plate(node, {});
  RetardanceDispersion dispersion;
  dispersion.design_wavelength =
      node.number({"design_wavelength_nm", "wavelength of the retardance", Range::closed(300, 2000), 550.0});
  dispersion.ratio =
      node.number({"dispersion_ratio", "retardance in nm at 450 nm over that at 550 nm", Range::closed(0.8, 1.3), 1.0});
  const double retardance = read_retardance(node, dispersion.design_wavelength);
  const auto at = [plate, dispersion, retardance](double wavelength) {
    WavePlate::Spec spec = plate;
    spec.retardance = retardance_phase(retardance * dispersion.factor(wavelength), wavelength);
    return FilmOptics{std::make_unique<WavePlate>(spec), {}};
  };
  film.axis = plate.fast_axis;
  film.axis_index = plate.index;
  film.surface = at(kSurfaceWavelength).surface;
  film.at_wavelength = at;
  return film;
}

}  // namespace evenglow::tracer

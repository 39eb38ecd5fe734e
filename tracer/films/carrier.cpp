#include "tracer/films/carrier.h"

#include <cmath>
#include <memory>

#include "tracer/films/film_keys.h"
#include "tracer/films/retarder.h"

namespace evenglow::tracer {
namespace {

constexpr double kSurfaceWavelength = 550.0;  // nm, of Film::surface

/// Biaxially stretched polyester: mean index 1.64, in the plane 0.02 to 0.1 apart.
WavePlate::Spec polyester() {
  WavePlate::Spec spec;
  spec.index = 1.64;
  spec.birefringence = 0.05;
  spec.faces = true;
  return spec;
}

}  // namespace

Film make_carrier(const core::ConfigNode& node) {
  Film film = film_of("carrier", node);
  const WavePlate::Spec plate = read_wave_plate(node, polyester());
  const double mean =
      node.number({"retardance_nm", "mean retardance at normal incidence", core::Range::closed(0, 1e6), 4000.0});
  const double spread = node.number({"retardance_spread_nm", "standard deviation of the retardance over the sheet",
                                     core::Range::closed(0, 1e6), 100.0});
  const double bandwidth =
      node.number({"bandwidth_nm", "standard deviation of the wavelengths that the traced one stands for",
                   core::Range::closed(0, 300), 20.0});
  const auto at = [=](double wavelength) {
    WavePlate::Spec spec = plate;
    spec.retardance = retardance_phase(mean, wavelength);
    spec.spread =
        std::hypot(retardance_phase(spread, wavelength), retardance_phase(mean, wavelength) * bandwidth / wavelength);
    return FilmOptics{std::make_unique<WavePlate>(spec), {}};
  };
  film.axis = plate.fast_axis;
  film.axis_index = plate.index;
  film.surface = at(kSurfaceWavelength).surface;
  film.at_wavelength = at;
  return film;
}

}  // namespace evenglow::tracer

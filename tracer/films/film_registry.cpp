#include "tracer/films/film_registry.h"

#include "tracer/films/film_makers.h"

namespace evenglow::tracer {

const core::Registry<Film>& film_registry() {
  static const core::Registry<Film> kinds({
      {"dbef", "reflective polarizer: ideal, or scattering by a table of its polarized BSDF", make_dbef},
      {"lpp", "absorbing linear polarizer", make_lpp},
      {"diffuser", "scatters and may depolarize", make_diffuser},
      {"sheet", "plain dielectric sheet with two smooth faces", make_sheet},
  });
  return kinds;
}

}  // namespace evenglow::tracer

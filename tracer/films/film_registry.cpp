#include "tracer/films/film_registry.h"

#include "tracer/films/bef_maker.h"
#include "tracer/films/carrier.h"
#include "tracer/films/diffuser_maker.h"
#include "tracer/films/film_makers.h"
#include "tracer/films/mueller_film_maker.h"
#include "tracer/films/retarder.h"
#include "tracer/films/sheet.h"
#include "tracer/films/wire_grid_maker.h"

namespace evenglow::tracer {

const core::Registry<Film>& film_registry() {
  static const core::Registry<Film> kinds({
      {"dbef", "reflective polarizer: ideal, or scattering by a table of its polarized BSDF", make_dbef},
      {"mueller_table", "scattering film from a table of its Mueller matrices", make_mueller_table},
      {"bef", "prism film (brightness enhancement or turning film), traced through its prisms", make_bef},
      {"lpp", "absorbing linear polarizer", make_lpp},
      {"wire_grid", "reflective polarizer of fine metal wires", make_wire_grid},
      {"retarder", "wave plate", make_retarder},
      {"carrier", "birefringent carrier sheet, mixes polarization states", make_carrier},
      {"diffuser", "scatters and may depolarize", make_diffuser},
      {"sheet", "dielectric sheet with two smooth faces, clear or scattering in its bulk", make_sheet},
  });
  return kinds;
}

}  // namespace evenglow::tracer

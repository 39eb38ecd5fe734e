#include "app/commands/film.h"

#include <string>

#include <CLI/CLI.hpp>

namespace evenglow::app {
namespace {

struct FilmEntry {
  const char* name;
  const char* help;
  const char* example;
  std::unique_ptr<FilmCommand> (*make)();
};

/// One line for each command.
constexpr FilmEntry kFilmCommands[] = {
    {"reconstruct", "readings behind polarizers to a polarized BSDF table with standard errors",
     "evenglow film reconstruct readings.csv -o film.csv", make_film_reconstruct},
    {"check", "is a BSDF table physical? energy, reciprocity, grid, units; one line for each fault",
     "evenglow film check configs/data/dbef.csv", make_film_check},
    {"convert", "a film table from CSV to HDF5 or back, without loss", "evenglow film convert film.csv film.h5",
     make_film_convert},
    {"goniometer", "virtual goniometer: luminance of a lit film, evaluated and traced, against measured tables",
     "evenglow film goniometer configs/dbef_goniometer.yaml", make_film_goniometer},
    {"fit", "fit the semi-empirical DBEF model to luminance tables; standard errors and cross-validation",
     "evenglow film fit --reflection configs/data/dbef_reflection_luminance.csv --transmission "
     "configs/data/dbef_transmission_luminance.csv -o fitted.yaml",
     make_film_fit},
    {"sweep", "transmittance, reflectance and polarization of any film against angle, azimuth and wavelength",
     "evenglow film sweep configs/phone_dbef.yaml --film 1 --sigma 0:80:10 --polarization all -o dbef.csv",
     make_film_sweep},
};

}  // namespace

void FilmGroup::add_to(CLI::App& program) {
  CLI::App* group = program.add_subcommand("film", "readings, tables and measurements of polarizing films");
  group->require_subcommand(1);
  group->footer("Example: evenglow film check configs/data/dbef.csv\nCOMMAND --help explains each command.");
  for (const FilmEntry& entry : kFilmCommands) {
    CLI::App* sub = group->add_subcommand(entry.name, entry.help);
    sub->footer(std::string("Example: ") + entry.example);
    FilmCommand* command = commands_.emplace_back(entry.make()).get();
    command->add_options(*sub);
    sub->callback([this, command] { chosen_ = command; });
  }
}

}  // namespace evenglow::app

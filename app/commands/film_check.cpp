#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "core/base/units.h"
#include "tracer/polarized_bsdf/stored_table.h"
#include "tracer/polarized_bsdf/table_check.h"

namespace evenglow::app {
namespace {

void print_hemispherical(const tracer::TableCheck& check) {
  if (check.hemispherical.empty()) return;
  fmt::print("{:>9} {:>9} | {:>7} {:>7} {:>7} | {:>7} {:>7} {:>7} | {:>8}\n", "lambda_nm", "sigma_deg", "R pass",
             "T pass", "R+T", "R block", "T block", "R+T", "greatest");
  for (const tracer::HemisphericalLine& line : check.hemispherical) {
    fmt::print("{:>9} {:>9.4g} | {:>7.4f} {:>7.4f} {:>7.4f} | {:>7.4f} {:>7.4f} {:>7.4f} | {:>8.4f}\n", line.lambda_nm,
               line.sigma / core::kRadPerDeg, line.reflectance_pass, line.transmittance_pass,
               line.reflectance_pass + line.transmittance_pass, line.reflectance_block, line.transmittance_block,
               line.reflectance_block + line.transmittance_block, line.greatest);
  }
  fmt::print("R, T: into the hemisphere, mean over psi; greatest: R + T over psi and all polarizations\n");
}

class FilmCheck final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command.add_option("TABLE", table_, "BSDF table or table of Mueller matrices (1/sr, degrees, nm), CSV or HDF5")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--hemispherical", hemispherical_,
                    "hemispherical R and T (1) that the table will be normalized to, such as "
                    "configs/data/dbef_hemispherical.csv (default: none)")
        ->type_name("FILE");
    command
        .add_option("--energy-tolerance", options_.energy_tolerance,
                    "how far R + T (1) may pass 1 by interpolation (default 0.02)")
        ->check(CLI::Range(0.0, 10.0))
        ->type_name("X");
    command
        .add_option("--reciprocity-tolerance", options_.reciprocity_tolerance,
                    "mean relative difference of reversed paths (1) that is allowed (default 0.1)")
        ->check(CLI::Range(0.0, 2.0))
        ->type_name("X");
    command
        .add_option("--pass-index", options_.pass_index,
                    "refractive index (1) that turns the pass axis seen by oblique rays (default 1.58)")
        ->check(CLI::Range(1.0, 4.0))
        ->type_name("N");
  }

  int run(const Session&) override {
    std::optional<tracer::HemisphericalTable> hemispherical;
    if (!hemispherical_.empty()) hemispherical = tracer::HemisphericalTable::read(hemispherical_);
    options_.hemispherical = hemispherical ? &*hemispherical : nullptr;
    const std::string text = tracer::read_table_bytes(table_);
    const tracer::TableCheck check = tracer::check_table(text, table_.string(), options_);
    print_hemispherical(check);
    for (const std::string& remark : check.remarks) fmt::print("remark: {}\n", remark);
    if (check.faults.empty()) {
      fmt::print("{}: good\n", table_.string());
      return kDone;
    }
    std::fflush(stdout);
    for (const core::Fault& fault : check.faults) fmt::print(stderr, "{}\n", fault.to_string());
    return check.readable ? kFailed : kWrongInput;
  }

 private:
  std::filesystem::path table_, hemispherical_;
  tracer::TableCheckOptions options_;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_check() {
  return std::make_unique<FilmCheck>();
}

}  // namespace evenglow::app

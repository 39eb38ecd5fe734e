#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/text_output.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::app {
namespace {

class FilmConvert final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command.add_option("IN", in_, "film table (1/sr, degrees, nm), HDF5 if it ends in .h5 or .hdf5, else CSV")
        ->type_name("FILE")
        ->required();
    command.add_option("OUT", out_, "table to write, HDF5 or CSV by its ending")->type_name("FILE")->required();
    command.add_flag("--overwrite", overwrite_, "replace a file that is there (default: refuse)");
  }

  int run(const Session&) override {
    const tracer::StoredTable table = tracer::parse_stored_table(tracer::read_table_bytes(in_), in_.string());
    require_other_than_inputs({out_}, {in_});
    if (!overwrite_) require_free({out_});
    write_whole(out_, tracer::stored_bytes(table, tracer::names_hdf5(out_)));
    fmt::print("wrote {}: {} nodes of {}\n", out_.string(), table.nodes(),
               table.form == tracer::StoredForm::mueller ? "Mueller matrices" : "tau_min, tau_max, delta");
    return kDone;
  }

 private:
  std::filesystem::path in_, out_;
  bool overwrite_ = false;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_convert() {
  return std::make_unique<FilmConvert>();
}

}  // namespace evenglow::app

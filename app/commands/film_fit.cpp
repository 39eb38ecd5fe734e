#include <cmath>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/lobe_fit_text.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "tracer/polarized_bsdf/lobe_model.h"

namespace evenglow::app {
namespace {

class FilmFit final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command
        .add_option("--reflection", reflection_,
                    "luminance of reflected light: psi_deg,theta_deg,illumination,measured_cd_m2")
        ->required()
        ->type_name("FILE");
    command.add_option("--transmission", transmission_, "luminance of transmitted light, the same columns")
        ->required()
        ->type_name("FILE");
    command.add_option("-o,--out", out_, "run file for `evenglow film goniometer` with the fitted model")
        ->type_name("FILE");
    add_range(command, "--relative-error", fit_.relative_error, 0, 10, "error of a reading, as a share of it");
    add_range(command, "--absolute-error", fit_.absolute_error, 0, 1e9, "added to it, cd/m2");
    add_range(command, "--loss", fit_.loss_width, 0, 1e6, "width of the Cauchy loss in errors; 0: plain least squares");
    add_range(command, "--absorption", fit_.absorption, 0, 0.99, "share of the light that the film absorbs");
    command.add_option("--throughput", throughput_, "hold k1 + k2 of the filter at this value (default: fitted)")
        ->check(CLI::Range(1e-3, 2.0));
    command.add_option("--folds", folds_, "parts of the cross-validation (default 12; 0: none)")
        ->check(CLI::Range(0, 100000));
    command.add_option("--seed", seed_, "of the parting into folds (default 1)");
    command.add_flag("--overwrite", overwrite_, "replace the file that is there");
  }

  int run(const Session&) override {
    if (fit_.relative_error + fit_.absolute_error <= 0.0)
      refuse("--relative-error", "must not both be 0 with --absolute-error");
    if (!std::isnan(throughput_)) fit_.throughput = throughput_;
    require_other_than_inputs({out_}, {reflection_, transmission_});
    if (!out_.empty() && !overwrite_) require_free({out_});
    const auto reflection = tracer::LuminanceTable::read(reflection_, tracer::ScatterKind::reflection);
    const auto transmission = tracer::LuminanceTable::read(transmission_, tracer::ScatterKind::transmission);
    const std::size_t readings = reflection.rows.size() + transmission.rows.size();
    if (folds_ == 1 || static_cast<std::size_t>(folds_) > readings) {
      refuse("--folds", fmt::format("must be 0 or 2 to the number of readings ({}), got {}", readings, folds_));
    }
    const tracer::LobeFit fit = tracer::fit_lobes(reflection, transmission, fit_);
    fmt::print("{}", fit_summary(fit, readings));
    if (folds_ > 0) {
      fmt::print("{}", validation_summary(cross_validate(reflection, transmission, fit_, folds_, seed_)));
    }
    const tracer::LobeModel film(fit.parameters);  // says so if what was fitted is no film
    fmt::print("{}", hemispherical_summary(film));
    if (!out_.empty()) {
      write_whole(out_, fitted_run_file(fit, out_, reflection_, transmission_));
      fmt::print("wrote {}\n", out_.string());
    }
    return fit.converged ? kDone : kFailed;
  }

 private:
  static void add_range(CLI::App& command, const char* name, double& value, double least, double most,
                        const char* help) {
    command.add_option(name, value, fmt::format("{} (default {:g})", help, value))->check(CLI::Range(least, most));
  }

  [[noreturn]] static void refuse(const std::string& key, const std::string& message) {
    throw core::ConfigError(core::Fault{"", 0, 0, key, message});
  }

  std::filesystem::path reflection_, transmission_, out_;
  tracer::LobeFitOptions fit_;
  double throughput_ = std::nan("");
  int folds_ = 12;
  std::uint64_t seed_ = 1;
  bool overwrite_ = false;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_fit() {
  return std::make_unique<FilmFit>();
}

}  // namespace evenglow::app

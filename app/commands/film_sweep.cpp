#include "tracer/goniometer/film_sweep.h"

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/progress.h"
#include "app/run_file.h"
#include "app/sweep_options.h"
#include "app/sweep_picture.h"
#include "app/sweep_text.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "tracer/goniometer/sweep_file.h"

namespace evenglow::app {
namespace {

constexpr std::size_t kMostRows = 200'000;

class FilmSweep final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command.add_option("FILE.yaml", file_, "file with one film (key film), or a run file")
        ->required()
        ->type_name("FILE");
    command.add_option("--film", film_, "of a run file: which of backlight.films, from 0")
        ->check(CLI::Range(0, 1000))
        ->type_name("INDEX");
    add_values(command, "--sigma", sigma_, "angles of incidence, degrees, [0, 90)");
    add_values(command, "--azimuth", azimuth_,
               "directions of the light in the film's plane from +x, degrees, [0, 360)");
    add_values(command, "--wavelength", wavelength_, "nm, [300, 2000]");
    command
        .add_option("--polarization", polarization_,
                    "incident light: all, or some of none, pass, block, 45, right, left, parted by commas (default "
                    "none,pass,block); pass: along the film's axis as the ray sees it")
        ->type_name("NAMES");
    command.add_option("--from", from_, "side of the light: below (plate) or above (viewer) (default below)")
        ->check(CLI::IsMember({"below", "above"}))
        ->type_name("SIDE");
    command.add_option("--photons", photons_, "of each row of a film that scatters; others are exact (default 1e5)")
        ->type_name("N");
    command.add_option("--seed", seed_, "seed of the random numbers (default 1)")->type_name("N");
    command.add_option("--threads", threads_, "threads (default 0: all; the result does not depend on it)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_option("--set", set_, "change a key of the file: film.axis_deg=45 (may be repeated)")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
    command.add_option("-o,--out", out_, "table of all rows; a picture of its name with the ending .png beside it")
        ->type_name("FILE.csv");
    command.add_flag("--quiet", quiet_, "no progress on stderr");
    command.add_flag("--overwrite", overwrite_, "replace files that are there");
  }

  int run(const Session& session) override {
    tracer::SweepSpec spec = read_spec();
    spec.stop = session.stop;
    const std::filesystem::path picture = picture_path();
    require_other_than_inputs({out_, picture}, {file_});
    if (!out_.empty() && !overwrite_) require_free({out_, picture});
    Options options;
    options.set = set_;
    const tracer::Film film = tracer::read_swept_film(file_, film_, option_overrides(options));
    const auto rows = measured(film, spec);
    if (!rows) return kInterrupted;
    for (const std::string& remark : film.remarks) fmt::print("film: {}\n", remark);
    const std::string what = fmt::format("{} film of {}", film.kind, file_.filename().string());
    if (!out_.empty()) {
      write_whole(out_, sweep_csv(*rows, what, spec.from_above));
      write_sweep_picture(*rows, what, picture);
    }
    fmt::print("{}", sweep_table(*rows));
    if (!out_.empty()) fmt::print("wrote {} and {}\n", out_.string(), picture.string());
    return kDone;
  }

 private:
  static void add_values(CLI::App& command, const char* name, std::string& value, const char* help) {
    command
        .add_option(name, value, fmt::format("{}: FROM:TO:STEP, or values parted by commas (default {})", help, value))
        ->type_name("VALUES");
  }

  [[noreturn]] static void refuse(const std::string& option, const std::string& message) {
    throw core::ConfigError(core::Fault{option, 0, 0, "", message});
  }

  tracer::SweepSpec read_spec() const {
    tracer::SweepSpec spec;
    spec.sigmas = sweep_values("--sigma", sigma_, {0, 90, true});
    spec.azimuths = sweep_values("--azimuth", azimuth_, {0, 360, true});
    spec.wavelengths = sweep_values("--wavelength", wavelength_, {300, 2000, false});
    for (double& angle : spec.sigmas) angle *= core::kRadPerDeg;
    for (double& angle : spec.azimuths) angle *= core::kRadPerDeg;
    spec.lights = sweep_lights(polarization_);
    const std::size_t most = kMostRows / spec.sigmas.size() / spec.azimuths.size() / spec.lights.size();
    if (spec.wavelengths.size() > most) {
      refuse("film sweep", fmt::format("must have at most {} rows, got {} angles x {} azimuths x {} polarizations x {} "
                                       "wavelengths",
                                       kMostRows, spec.sigmas.size(), spec.azimuths.size(), spec.lights.size(),
                                       spec.wavelengths.size()));
    }
    spec.from_above = from_ == "above";
    spec.photons = sweep_photons(photons_);
    spec.seed = seed_;
    spec.threads = threads_;
    return spec;
  }

  std::filesystem::path picture_path() const {
    if (out_.empty()) return {};
    std::filesystem::path picture = out_;
    picture.replace_extension(".png");
    if (picture == out_) refuse("--out", "must name a table (FILE.csv), got " + out_.string());
    return picture;
  }

  std::optional<std::vector<tracer::SweepRow>> measured(const tracer::Film& film, tracer::SweepSpec& spec) const {
    Progress progress(quiet_ || !tracer::needs_photons(film));
    const std::uint64_t rows = spec.sigmas.size() * spec.azimuths.size() * spec.lights.size() * spec.wavelengths.size();
    spec.progress = [&](std::uint64_t done) { progress.photons(done, rows * spec.photons); };
    progress.begin("film sweep");
    auto result = tracer::sweep_film(film, spec);
    if (!result) progress.line("interrupted: nothing was written");
    return result;
  }

  std::filesystem::path file_, out_;
  std::optional<int> film_;
  std::string sigma_ = "0:85:5", azimuth_ = "0", wavelength_ = "550";
  std::string polarization_ = "none,pass,block", from_ = "below", photons_ = "1e5";
  std::uint64_t seed_ = 1;
  int threads_ = 0;
  std::vector<std::string> set_;
  bool quiet_ = false;
  bool overwrite_ = false;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_sweep() {
  return std::make_unique<FilmSweep>();
}

}  // namespace evenglow::app

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/commands/film.h"
#include "app/text_output.h"
#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "tracer/polarized_bsdf/reconstruction.h"
#include "tracer/polarized_bsdf/reconstruction_writer.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::app {
namespace {

using tracer::NodeResult;
using tracer::Reconstruction;

constexpr double kNotable = 3.0;  ///< standard errors
constexpr std::size_t kMostShown = 5;

const std::map<std::string, tracer::AngleOrigin> kOrigins{{"film", tracer::AngleOrigin::film},
                                                          {"laboratory", tracer::AngleOrigin::laboratory}};
const std::map<std::string, tracer::DiattenuationBias> kBiases{{"none", tracer::DiattenuationBias::none},
                                                               {"square", tracer::DiattenuationBias::square},
                                                               {"amplitude", tracer::DiattenuationBias::amplitude}};

/// TABLE.csv -> TABLE.<part>.csv.
std::filesystem::path beside(const std::filesystem::path& table, const std::string& part) {
  std::filesystem::path path = table;
  path.replace_filename(table.stem().string() + "." + part + table.extension().string());
  return path;
}

/// The nodes with the largest `measure` above the limit, and how many there are.
template <typename Measure>
void print_notable(const Reconstruction& result, const char* what, const Measure& measure) {
  std::vector<const NodeResult*> notable;
  for (const NodeResult& node : result.nodes) {
    if (measure(node) > kNotable) notable.push_back(&node);
  }
  fmt::print("{}: {} of {} nodes beyond {} standard errors\n", what, notable.size(), result.nodes.size(), kNotable);
  std::ranges::stable_sort(notable, std::ranges::greater{}, [&](const NodeResult* n) { return measure(*n); });
  notable.resize(std::min(notable.size(), kMostShown));
  for (const NodeResult* node : notable) {
    fmt::print("  {}:{}: {}: {:.1f} standard errors\n", result.name, node->line, node->node.to_string(),
               measure(*node));
  }
}

void print_errors(const Reconstruction& result) {
  if (result.estimated_error) {
    fmt::print("errors: none given; from the redundant readings {:.3g} % of the readings of a node\n",
               100.0 * *result.estimated_error);
  } else if (!result.has_errors) {
    fmt::print("errors: none given and too few redundant readings; the table has no standard errors\n");
  } else {
    double chi_square = 0.0;
    int degrees = 0;
    for (const NodeResult& node : result.nodes) {
      chi_square += node.chi_square;
      degrees += node.degrees_of_freedom;
    }
    if (degrees > 0)
      fmt::print("chi-square / degrees of freedom: {:.1f} / {} = {:.3f}\n", chi_square, degrees, chi_square / degrees);
  }
}

void print_summary(const Reconstruction& result) {
  std::size_t reflection = 0, clipped = 0, unpolarized = 0;
  for (const NodeResult& node : result.nodes) {
    reflection += node.node.kind == tracer::ScatterKind::reflection ? 1 : 0;
    clipped += node.values.clipped ? 1 : 0;
    // delta_se = sd(D sideways) / (2 D): above 1/4 rad D is below twice its error.
    unpolarized += node.values.delta_se > 0.25 ? 1 : 0;
  }
  fmt::print("{}: polarizers in {}; {} nodes (BRDF {}, BTDF {})\n", result.name,
             result.general ? "both channels" : "the illumination channel", result.nodes.size(), reflection,
             result.nodes.size() - reflection);
  print_errors(result);
  if (result.has_errors)
    print_notable(result, "redundant readings disagree", [](const NodeResult& n) { return n.excess(); });
  if (result.general) {
    print_notable(result, "no physical matrix fits", [](const NodeResult& n) { return n.contradiction(); });
  }
  if (clipped > 0) fmt::print("tau_min below zero, set to zero: {} nodes\n", clipped);
  if (unpolarized > 0)
    fmt::print("polarization within twice its standard error, delta is uncertain: {} nodes\n", unpolarized);
}

class FilmReconstruct final : public FilmCommand {
 public:
  void add_options(CLI::App& command) override {
    command
        .add_option("READINGS.csv", readings_,
                    "readings, 1/sr: columns b0,b45,b90,b135, or in_kind ... value,se (docs/films.md)")
        ->type_name("FILE")
        ->required();
    command
        .add_option("-o,--out", table_,
                    "table to write, CSV or HDF5 (.h5, .hdf5); of general readings also TABLE.mueller.csv (.h5)")
        ->type_name("FILE")
        ->required();
    command
        .add_option(
            "--angles", angles_,
            "polarizer angles (degrees) count from: film (its pass axis; default) or laboratory (e1 of the ray)")
        ->type_name("FROM")
        ->transform(CLI::IsMember(std::vector<std::string>{"film", "laboratory"}));
    command
        .add_option("--bias", bias_,
                    "take the upward bias off D = tau_max - tau_min: none (default), square (D^2 without bias: D^2 - 4 "
                    "s^2), amplitude (D to first order: D^2 - 2 s^2)")
        ->type_name("KIND")
        ->transform(CLI::IsMember(std::vector<std::string>{"none", "square", "amplitude"}));
    add_transmittances(command, "--k", options_.polarizer, "polarizer of the illumination");
    general_options_ = add_transmittances(command, "--analyzer-k", options_.analyzer,
                                          "analyzer of the observation (general readings)");
    general_options_.push_back(command.add_flag("--covariance", covariance_,
                                                "of general readings also write TABLE.covariance.csv (136 columns)"));
    command.add_option("--threads", threads_, "threads (default 0: all; the result does not depend on it)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_flag("--overwrite", overwrite_, "replace files that are there");
  }

  int run(const Session& session) override {
    check_transmittances("--k", options_.polarizer);
    check_transmittances("--analyzer-k", options_.analyzer);
    options_.angles = kOrigins.at(angles_);
    options_.bias = kBiases.at(bias_);
    const auto readings = tracer::FilmReadings::read(readings_);
    if (!readings.general()) refuse_general_options();
    std::vector<std::filesystem::path> paths{table_};
    if (readings.general()) paths.push_back(beside(table_, "mueller"));
    if (readings.general() && covariance_) paths.push_back(beside(table_, "covariance").replace_extension(".csv"));
    require_other_than_inputs(paths, {readings_});
    if (!overwrite_) require_free(paths);
    bool whole = true;
    const Reconstruction result =
        tracer::reconstruct(readings, options_, [&](std::size_t count, const std::function<void(std::size_t)>& work) {
          whole = core::run_batches(count, threads_, work, session.stop);
        });
    if (!whole) return kInterrupted;
    const std::string table = tracer::table_text(result);
    tracer::BsdfTable::parse(table, result.name);  // a grid with holes is of no use to anyone: say so, write nothing
    print_summary(result);
    write(paths[0], table);
    if (readings.general()) write(paths[1], tracer::mueller_text(result));
    if (paths.size() > 2) write(paths[2], tracer::covariance_text(result));
    return kDone;
  }

 private:
  static std::vector<CLI::Option*> add_transmittances(CLI::App& command, const std::string& name,
                                                      tracer::PrincipalTransmittances& k, const std::string& what) {
    return {command
                .add_option(name + "1", k.k1,
                            "greatest transmittance of the " + what + " for linear light, 0 to 1 (default 1)")
                ->type_name("T"),
            command.add_option(name + "2", k.k2, "its least transmittance, below the greatest (default 0: ideal)")
                ->type_name("T")};
  }

  /// They would change nothing in a table of four-angle readings.
  void refuse_general_options() const {
    for (const CLI::Option* option : general_options_) {
      if (option->count() == 0) continue;
      throw core::ConfigError(core::Fault{readings_.string(), 0, 0, option->get_name(),
                                          "needs general readings (columns in_kind ... value, se), got readings at "
                                          "four angles"});
    }
  }

  static void check_transmittances(const std::string& name, const tracer::PrincipalTransmittances& k) {
    if (k.k1 <= 1.0 && k.k2 >= 0.0 && k.k2 < k.k1) return;
    throw core::ConfigError(core::Fault{"", 0, 0, name + "1, " + name + "2",
                                        fmt::format("must keep 0 <= k2 < k1 <= 1, got k1 = {}, k2 = {}", k.k1, k.k2)});
  }

  /// As CSV, or a table as HDF5 where its name says so.
  static void write(const std::filesystem::path& path, const std::string& text) {
    const bool hdf5 = tracer::names_hdf5(path);
    write_whole(path, hdf5 ? tracer::stored_bytes(tracer::parse_csv_table(text, path.string()), true) : text);
    fmt::print("wrote {}\n", path.string());
  }

  std::filesystem::path readings_, table_;
  std::string angles_ = "film", bias_ = "none";
  tracer::ReconstructionOptions options_;
  std::vector<CLI::Option*> general_options_;  ///< for readings with an analyzer alone; owned by the command
  int threads_ = 0;
  bool covariance_ = false, overwrite_ = false;
};

}  // namespace

std::unique_ptr<FilmCommand> make_film_reconstruct() {
  return std::make_unique<FilmReconstruct>();
}

}  // namespace evenglow::app

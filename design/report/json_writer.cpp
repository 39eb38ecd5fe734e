#include "design/report/json_writer.h"

#include <nlohmann/json.hpp>

#include "design/report/json_dots.h"
#include "design/report/json_metrology.h"
#include "design/report/output_file.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;

/// Ill-formed UTF-8 (file names may hold it) is replaced, never a reason to fail at the end of a long run.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json steps_of(const Report& report) {
  Json steps = Json::array();
  for (const StepRecord& s : report.steps) {
    steps.push_back({{"step", s.step},
                     {"photons", s.photons},
                     {"rms", s.rms},
                     {"rms_corrected", s.rms_corrected.value},
                     {"rms_corrected_se", s.rms_corrected.se},
                     {"efficiency", s.efficiency.value},
                     {"efficiency_se", s.efficiency.se},
                     {"mean_density", s.mean_density},
                     {"luminance_mean_cd_m2", s.luminance_mean},
                     {"noise", s.noise},
                     {"held_low", s.held_low},
                     {"held_high", s.held_high},
                     {"updater", s.updater},
                     {"level_photons", s.level_photons}});
  }
  return steps;
}

/// A key for a name, or for its second bearer "name (2)": no share is lost from the sum.
std::string free_key(const Json& object, const std::string& name) {
  std::string key = name;
  for (int number = 2; object.contains(key); ++number) key = name + " (" + std::to_string(number) + ")";
  return key;
}

Json shares_of(const std::vector<EnergyShare>& shares, double core::Estimate::*part) {
  Json object = Json::object();
  for (const EnergyShare& share : shares) object[free_key(object, share.name)] = share.share.*part;
  return object;
}

Json energy_of(const EnergyAccount& energy, double core::Estimate::*part) {
  return {{"escaped", shares_of(energy.escaped, part)},
          {"absorbed", shares_of(energy.absorbed, part)},
          {"lost", energy.lost.*part}};
}

Json energy_values(const EnergyAccount& energy) {
  Json object{{"emitted_lm", energy.emitted_lm}};
  object.update(energy_of(energy, &core::Estimate::value));
  return object;
}

Json timing_of(const Report& report) {
  Json steps = Json::array();
  for (const StepRecord& s : report.steps) {
    steps.push_back({{"step", s.step}, {"cpu_s", s.cpu_s}, {"wall_s", s.wall_s}});
  }
  return {{"wall_s", report.timing.wall_s},
          {"cpu_s", report.timing.cpu_s},
          {"photons_per_cpu_s", report.timing.photons_per_cpu_s},
          {"processor", report.processor},
          {"steps", std::move(steps)}};
}

Json variant_of(const Report& report) {
  Json variant = final_json(report.final);
  variant["emitted_lm"] = report.energy.emitted_lm;
  variant["energy"] = energy_values(report.energy);
  variant["steps"] = report.steps.size();
  variant["stop_reason"] = report.stop_reason;
  variant["overrides"] = report.overrides;
  variant["seed"] = report.seed;
  variant["run_file_sha256"] = report.run_file_sha256;
  add_metrology(report, variant);
  if (report.dots) variant["dots"] = dots_json(report);
  return variant;
}

}  // namespace

std::string result_json(const Report& report) {
  Json object{{"format", "evenglow-result/1"},
              {"version", report.version},
              {"program_build_id", report.build_id},
              {"title", report.title},
              {"variant", report.variant},
              {"command", report.command},
              {"overrides", report.overrides},
              {"run_file_sha256", report.run_file_sha256},
              {"seed", report.seed},
              {"threads", report.threads},
              {"ranks", report.ranks},
              {"stop_reason", report.stop_reason},
              {"luminance_estimator", report.luminance_estimator},
              {"density_limits", {report.density_min, report.density_max}},
              {"steps", steps_of(report)},
              {"final", final_json(report.final)},
              {"energy", energy_values(report.energy)},
              {"energy_se", energy_of(report.energy, &core::Estimate::se)},
              {"notes", report.notes}};
  add_metrology(report, object);
  if (report.dots) object["dots"] = dots_json(report);
  object["timing"] = timing_of(report);
  return text_of(object);
}

std::string comparison_json(const Comparison& comparison) {
  Json variants = Json::object();
  for (const Report& report : comparison.variants) variants[report.variant] = variant_of(report);
  Json ratios = Json::object();
  for (const VariantRatio& r : comparison.ratios) {
    ratios[r.name] = {
        {"luminance", r.luminance.value}, {"luminance_se", r.luminance.se},   {"flux", r.flux.value},
        {"flux_se", r.flux.se},           {"efficiency", r.efficiency.value}, {"efficiency_se", r.efficiency.se}};
  }
  return text_of({{"format", "evenglow-compare/1"},
                  {"version", comparison.variants.empty() ? "" : comparison.variants[0].version},
                  {"title", comparison.title},
                  {"command", comparison.command},
                  {"variants", std::move(variants)},
                  {"ratio", std::move(ratios)}});
}

void JsonWriter::write(const Report& report, const std::filesystem::path& directory) const {
  write_file(directory / "result.json", result_json(report));
}

void JsonWriter::write(const Comparison& comparison, const std::filesystem::path& directory) const {
  write_file(directory / "compare.json", comparison_json(comparison));
}

}  // namespace evenglow::design

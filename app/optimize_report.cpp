#include "app/optimize_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/version.h"
#include "core/config/json_depth.h"
#include "design/engine/state_file.h"
#include "design/engine/stop_rule.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"

namespace evenglow::app {
namespace {

using design::OuterResult;
using Json = nlohmann::ordered_json;

constexpr const char* kStateFormat = "evenglow-optimize-state/2";

Json to_json(const OuterResult& r) {
  return {{"values", r.values},
          {"efficiency", r.efficiency.value},
          {"efficiency_se", r.efficiency.se},
          {"rms_corrected", r.rms.value},
          {"rms_corrected_se", r.rms.se},
          {"photons", r.photons},
          {"cpu_s", r.cpu_s}};
}

OuterResult result_from(const Json& node) {
  OuterResult r;
  r.values = node.at("values").get<std::vector<double>>();
  r.efficiency = {node.at("efficiency").get<double>(), node.at("efficiency_se").get<double>()};
  r.rms = {node.at("rms_corrected").get<double>(), node.at("rms_corrected_se").get<double>()};
  r.photons = node.at("photons").get<std::uint64_t>();
  r.cpu_s = node.at("cpu_s").get<double>();
  // What no design gives. (JSON knows neither infinity nor what is no number.)
  constexpr double kMostRms = 1e4;  // of all light in one of 1e8 cells
  const auto is_error = [](double se) { return se >= 0.0 && se <= kMostRms; };
  if (!(r.efficiency.value >= 0.0 && r.efficiency.value <= 1.0 + 1e-9 && is_error(r.efficiency.se) &&
        std::abs(r.rms.value) <= kMostRms && is_error(r.rms.se) && r.cpu_s >= 0.0))
    throw core::Error("a design of it has figures out of range");
  return r;
}

core::Estimate gain_of(const OptimizeVerdict& verdict) {
  const auto& a = verdict.start.efficiency;
  const auto& b = verdict.improved.efficiency;
  return {b.value - a.value, std::hypot(a.se, b.se)};
}

bool keeps(const OuterResult& result, double bound) {
  return design::shows_bound(result.rms, bound);
}

std::string percent(double share) {
  return fmt::format("{:.4g} %", 100.0 * share);
}

std::string verdict_text(const Run& run, const OptimizeVerdict& verdict) {
  std::string keys;
  for (std::size_t i = 0; i < run.outer.variables.size(); ++i) {
    keys += fmt::format("{}{} = {:.4g}", i == 0 ? "" : ", ", run.outer.variables[i].key, verdict.improved.values[i]);
  }
  const core::Estimate gain = gain_of(verdict);
  const std::string bound = percent(run.outer.rms);
  const std::string head = verdict.feasible ? "Best: " : "No design keeps the bound of " + bound + "; the nearest is ";
  const std::string tail = verdict.feasible && !keeps(verdict.improved, run.outer.rms)
                               ? " Judged so, it does not keep the bound of " + bound + "."
                               : "";
  return fmt::format(
      "{}{}. Judged with fresh random numbers: efficiency {} % at an RMS of {} %, against {} % at {} % at the "
      "start: "
      "{} percentage points, {:.1f} standard errors.{}",
      head, keys, design::measured(verdict.improved.efficiency, 100.0), design::measured(verdict.improved.rms, 100.0),
      design::measured(verdict.start.efficiency, 100.0), design::measured(verdict.start.rms, 100.0),
      design::measured(gain, 100.0), gain.se > 0.0 ? gain.value / gain.se : 0.0, tail);
}

design::CurvePlot result_plot(const std::vector<OuterResult>& results, bool rms, double bound) {
  design::CurvePlot plot{rms ? "RMS of each design" : "Efficiency of each design",
                         "design",
                         rms ? "RMS non-uniformity (%)" : "efficiency (%)",
                         false,
                         true,
                         false,
                         {}};
  design::Curve each, best;
  each.name = rms ? "RMS, noise taken off" : "efficiency";
  each.joined = false;
  best.name = rms ? "bound" : "best that keeps the bound";
  best.ink = design::Ink::series_2;
  best.marked = false;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const core::Estimate value = rms ? results[i].rms : results[i].efficiency;
    each.x.push_back(static_cast<double>(i));
    each.y.push_back(100.0 * value.value);
    each.se.push_back(100.0 * value.se);
    const std::vector<OuterResult> so_far(results.begin(), results.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    const OptimizeVerdict chosen = choose_design(so_far, bound);
    if (!rms && !chosen.feasible) continue;
    best.x.push_back(static_cast<double>(i));
    best.y.push_back(100.0 * (rms ? bound : so_far[chosen.best].efficiency.value));
  }
  plot.curves = {each};
  if (!best.x.empty()) plot.curves.push_back(best);
  return plot;
}

design::CurvePlot key_plot(const Run& run, const std::vector<OuterResult>& results) {
  design::CurvePlot plot{"The keys, each over its range", "design", "share of the range", false, true, true, {}};
  for (std::size_t k = 0; k < run.outer.variables.size(); ++k) {
    const design::OuterVariable& v = run.outer.variables[k];
    design::Curve curve;
    curve.name = v.key;
    curve.ink = design::series_ink(k);
    for (std::size_t i = 0; i < results.size(); ++i) {
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back((results[i].values[k] - v.low) / (v.high - v.low));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace

OptimizeVerdict choose_design(const std::vector<OuterResult>& results, double rms_bound) {
  const auto better = [&](const OuterResult& a, const OuterResult& b) {
    const bool a_keeps = keeps(a, rms_bound), b_keeps = keeps(b, rms_bound);
    if (a_keeps != b_keeps) return a_keeps;
    return a_keeps ? a.efficiency.value > b.efficiency.value : a.rms.value < b.rms.value;
  };
  const auto best = std::min_element(results.begin(), results.end(), better);
  OptimizeVerdict verdict;
  verdict.best = static_cast<std::size_t>(best - results.begin());
  verdict.feasible = keeps(*best, rms_bound);
  return verdict;
}

design::Study optimize_study(const Run& run, const std::string& command, const std::vector<OuterResult>& results,
                             const OptimizeVerdict& verdict) {
  design::Study study;
  study.title = run.title + ": search over scalar keys";
  study.version = core::version();
  study.command = command;
  study.run_file = run.file_text;
  study.lead = fmt::format(
      "A design of the density at each point, judged by an independent trace; all points share their random numbers. "
      "{} "
      "looks for the highest efficiency with an RMS of at most {:.2f} %. {}",
      run.outer.method, 100.0 * run.outer.rms, verdict_text(run, verdict));
  study.columns = {"design"};
  for (const auto& v : run.outer.variables) study.columns.push_back(v.key);
  study.columns.insert(study.columns.end(), {"efficiency (%)", "RMS (%)", "photons", ""});
  for (std::size_t i = 0; i < results.size(); ++i) {
    std::vector<std::string> row = {std::to_string(i)};
    for (const double value : results[i].values) row.push_back(fmt::format("{:.5g}", value));
    row.push_back(design::measured(results[i].efficiency, 100.0));
    row.push_back(design::measured(results[i].rms, 100.0));
    row.push_back(fmt::format("{:.3g}", static_cast<double>(results[i].photons)));
    row.push_back(i != verdict.best ? "" : verdict.feasible ? "best" : "nearest");
    study.rows.push_back(std::move(row));
  }
  study.plots = {result_plot(results, false, run.outer.rms), result_plot(results, true, run.outer.rms),
                 key_plot(run, results)};
  study.notes = {verdict_text(run, verdict)};
  return study;
}

void write_optimize(const design::Study& study, const Run& run, const std::vector<OuterResult>& results,
                    const OptimizeVerdict& verdict, const std::filesystem::path& directory) {
  std::string csv = "design";
  Json keys = Json::array();
  for (const auto& v : run.outer.variables) {
    csv += ',' + v.key;
    keys.push_back({{"key", v.key}, {"range", {v.low, v.high}}});
  }
  csv += ",efficiency,efficiency_se,rms_corrected,rms_corrected_se,photons,cpu_s\n";
  Json rows = Json::array();
  for (std::size_t i = 0; i < results.size(); ++i) {
    const OuterResult& r = results[i];
    csv += std::to_string(i);
    for (const double value : r.values) csv += ',' + design::shortest(value);
    csv += fmt::format(",{},{},{},{},{},{}\n", design::shortest(r.efficiency.value), design::shortest(r.efficiency.se),
                       design::shortest(r.rms.value), design::shortest(r.rms.se), r.photons, design::shortest(r.cpu_s));
    rows.push_back(to_json(r));
  }
  const core::Estimate gain = gain_of(verdict);
  const Json json{{"format", "evenglow-optimize/1"},
                  {"version", study.version},
                  {"command", study.command},
                  {"method", run.outer.method},
                  {"rms_bound", run.outer.rms},
                  {"keys", std::move(keys)},
                  {"designs", std::move(rows)},
                  {"feasible", verdict.feasible && keeps(verdict.improved, run.outer.rms)},
                  {"best", verdict.best},
                  {"judged_anew",
                   {{"start", to_json(verdict.start)},
                    {"best", to_json(verdict.improved)},
                    {"efficiency_gain", gain.value},
                    {"efficiency_gain_se", gain.se}}}};
  design::write_file(directory / "optimize.csv", csv);
  design::write_file(directory / "optimize.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  design::write_file(directory / "optimize.html", design::study_html(study));
  design::write_study_png(study, directory / "optimize.png");
}

std::string optimize_state(const std::string& identity, const std::vector<OuterResult>& results) {
  Json rows = Json::array();
  for (const OuterResult& r : results) rows.push_back(to_json(r));
  return Json{{"format", kStateFormat}, {"identity", identity}, {"designs", std::move(rows)}}.dump();
}

std::vector<OuterResult> read_optimize_state(const std::filesystem::path& file, const std::string& identity,
                                             std::string& note) {
  std::vector<OuterResult> results;
  std::string found;
  const auto read = [&](const std::string& object) {
    results.clear();
    core::require_shallow_json(object);
    const Json node = Json::parse(object);
    if (node.at("format").get<std::string>() != kStateFormat) throw core::Error("it is of another version");
    found = node.at("identity").get<std::string>();
    for (const Json& row : node.at("designs")) results.push_back(result_from(row));
  };
  if (!design::load_state(file, read, note)) return {};
  if (found != identity)
    throw core::Error(
        file.string() +
        ": the checkpoint is of another run (another command or program, or the run file or an option has "
        "changed)");
  return results;
}

}  // namespace evenglow::app

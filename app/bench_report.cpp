#include "app/bench_report.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/version.h"
#include "design/report/number_format.h"
#include "design/report/output_file.h"

namespace evenglow::app {
namespace {

using design::MethodTrial;
using Json = nlohmann::ordered_json;

std::string with_spread(double median, double low, double high, double scale) {
  return fmt::format("{:.3g} ({:.3g}-{:.3g})", scale * median, scale * low, scale * high);
}

std::vector<std::string> table_row(const BenchCase& bench, const std::string& updater, double threshold,
                                   const design::EffortSummary& s) {
  std::vector<std::string> row = {bench.name, updater, fmt::format("{:g} %", 100.0 * threshold),
                                  fmt::format("{}/{}", s.reached, s.trials)};
  if (s.reached == 0) {
    row.push_back(fmt::format("> {}", s.in_vain.steps));
    row.push_back(fmt::format("> {:.3g}", 1e-6 * static_cast<double>(s.in_vain.photons)));
    row.push_back(fmt::format("> {:.3g}", s.in_vain.cpu_s));
    return row;
  }
  row.push_back(with_spread(s.steps, s.steps_low, s.steps_high, 1.0));
  row.push_back(with_spread(s.photons, s.photons_low, s.photons_high, 1e-6));
  row.push_back(with_spread(s.cpu_s, s.cpu_low, s.cpu_high, 1.0));
  return row;
}

/// The first trial of each updater.
design::CurvePlot progress_plot(const BenchFacts& facts, const BenchCase& bench, bool photons) {
  design::CurvePlot plot{bench.name + (photons ? ": RMS against photons" : ": RMS against CPU seconds"),
                         photons ? "log10 of photons" : "log10 of CPU seconds",
                         "RMS, noise taken off (%)",
                         true,
                         false,
                         false,
                         {}};
  for (std::size_t i = 0; i < facts.updaters.size(); ++i) {
    design::Curve curve;
    curve.name = facts.updaters[i];
    curve.ink = design::series_ink(i);
    for (const MethodTrial& trial : bench.trials) {
      if (trial.updater != facts.updaters[i]) continue;
      double spent = 0.0;
      for (std::size_t k = 0; k < trial.steps.size(); ++k) {
        spent += static_cast<double>(trial.steps[k].photons);
        curve.x.push_back(std::log10(photons ? spent : std::max(trial.cpu_s[k], 1e-3)));
        curve.y.push_back(100.0 * trial.steps[k].rms_corrected.value);
      }
      break;
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

std::string bench_csv(const BenchFacts& facts, const std::vector<BenchCase>& cases) {
  std::string text =
      "case,cells,updater,seed,threshold,reached,steps,photons,cpu_s,spent_steps,spent_photons,spent_cpu_s,"
      "final_rms_corrected,final_rms_corrected_se,stop_reason\n";
  for (const BenchCase& bench : cases) {
    for (const MethodTrial& trial : bench.trials) {
      for (std::size_t i = 0; i < facts.thresholds.size(); ++i) {
        const auto& e = trial.efforts[i];
        text += fmt::format("{},{},{},{},{:g},{},{},{},{},{},{},{},{},{},\"{}\"\n", bench.name, bench.cells,
                            trial.updater, trial.seed, facts.thresholds[i], e ? 1 : 0,
                            e ? std::to_string(e->steps) : "", e ? std::to_string(e->photons) : "",
                            e ? design::shortest(e->cpu_s) : "", trial.spent.steps, trial.spent.photons,
                            design::shortest(trial.spent.cpu_s), design::shortest(trial.judged.rms_corrected.value),
                            design::shortest(trial.judged.rms_corrected.se), trial.stop_reason);
      }
    }
  }
  return text;
}

Json summary_of(const BenchCase& bench, const BenchFacts& facts) {
  Json rows = Json::array();
  for (const std::string& updater : facts.updaters) {
    for (std::size_t i = 0; i < facts.thresholds.size(); ++i) {
      const design::EffortSummary s = design::summarize(bench.trials, updater, i);
      rows.push_back(
          {{"updater", updater},
           {"threshold", facts.thresholds[i]},
           {"trials", s.trials},
           {"reached", s.reached},
           {"steps", {s.steps, s.steps_low, s.steps_high}},
           {"photons", {s.photons, s.photons_low, s.photons_high}},
           {"cpu_s", {s.cpu_s, s.cpu_low, s.cpu_high}},
           {"in_vain", {{"steps", s.in_vain.steps}, {"photons", s.in_vain.photons}, {"cpu_s", s.in_vain.cpu_s}}}});
    }
  }
  return {{"case", bench.name}, {"title", bench.title}, {"cells", bench.cells}, {"median_low_high", std::move(rows)}};
}

}  // namespace

design::Study bench_study(const BenchFacts& facts, const std::vector<BenchCase>& cases) {
  design::Study study;
  study.title = "Bench of the design methods";
  study.version = core::version();
  study.command = facts.command;
  study.lead =
      "Each updater from the same start at the same level, under one stopping rule. Steps, photons and CPU seconds "
      "until "
      "a trace showed an RMS at or below the threshold, Monte Carlo noise taken off, with a standard error of at most "
      "half of it; that trace has random numbers that its density has never seen, and is counted. Median over the "
      "seeds that reached it (least-greatest); where none did, `>` and the least that one of them had spent.";
  study.columns = {"case", "updater", "RMS", "reached", "steps", "photons (millions)", "CPU s"};
  for (const BenchCase& bench : cases) {
    for (std::size_t i = 0; i < facts.thresholds.size(); ++i) {
      for (const std::string& updater : facts.updaters)
        study.rows.push_back(
            table_row(bench, updater, facts.thresholds[i], design::summarize(bench.trials, updater, i)));
    }
    study.plots.push_back(progress_plot(facts, bench, true));
    study.plots.push_back(progress_plot(facts, bench, false));
  }
  study.notes.push_back("Curves: the first seed.");
  return study;
}

void write_bench(const design::Study& study, const BenchFacts& facts, const std::vector<BenchCase>& cases,
                 const std::filesystem::path& directory) {
  Json json{{"format", "evenglow-bench-design/1"}, {"version", study.version}, {"command", study.command}};
  json["cases"] = Json::array();
  for (const BenchCase& bench : cases) json["cases"].push_back(summary_of(bench, facts));
  design::write_file(directory / "bench.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
  design::write_file(directory / "bench.csv", bench_csv(facts, cases));
  design::write_file(directory / "bench.txt", design::study_text(study));
  design::write_file(directory / "bench.html", design::study_html(study));
  design::write_study_png(study, directory / "bench.png");
}

}  // namespace evenglow::app

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/tolerance_report.h"
#include "core/base/version.h"
#include "design/tolerance/figures.h"

namespace evenglow::app {
namespace {

using Json = nlohmann::ordered_json;

Json share_json(const design::Share& share) {
  return {{"value", share.value}, {"low_95", share.low}, {"high_95", share.high}};
}

Json yield_json(const design::Yield& y) {
  return {{"passed", y.passed},         {"seen", share_json(y.seen)}, {"noise_taken_off", share_json(y.corrected)},
          {"near_limit", y.near_limit}, {"least", y.least},           {"most", y.most}};
}

Json limits_json(const ToleranceOutcome& o) {
  Json limits = Json::object();
  for (std::size_t i = 0; i < o.spec().limits.size(); ++i) {
    const design::Limit& limit = o.spec().limits[i];
    Json entry = Json::object();
    if (limit.min) entry["min"] = *limit.min;
    if (limit.max) entry["max"] = *limit.max;
    entry["yield"] = yield_json(o.summary.yields[i]);
    limits[limit.figure] = std::move(entry);
  }
  return limits;
}

Json sensitivity_json(const design::Sensitivity& s, const std::vector<std::string>& names) {
  Json effects = Json::object();
  for (std::size_t p = 0; p < names.size(); ++p)
    effects[names[p]] = {{"effect", s.effects[p].value}, {"se", s.effects[p].se}};
  return {{"per_standard_deviation", std::move(effects)}, {"explained", s.explained}, {"residual", s.residual}};
}

Json figure_json(const ToleranceOutcome& o, std::size_t i) {
  const design::FigureSummary& s = o.summary.figures[i];
  const design::Population& p = s.population;
  Json figure{{"nominal", o.run.reference[i].value},
              {"nominal_se", o.run.reference[i].se},
              {"mean", p.mean.value},
              {"mean_se", p.mean.se},
              {"spread_seen", p.seen},
              {"noise", p.noise},
              {"spread", p.spread.value},
              {"spread_se", p.spread.se},
              {"spread_95_low", p.spread_low},
              {"spread_95_high", p.spread_high},
              {"least", p.least},
              {"median", p.median},
              {"greatest", p.greatest},
              {"noise_shift", s.shift.value},
              {"noise_shift_se", s.shift.se}};
  if (s.sensitivity) figure["sensitivity"] = sensitivity_json(*s.sensitivity, design::parameter_names(o.spec()));
  return figure;
}

}  // namespace

std::string tolerance_json(const ToleranceOutcome& o) {
  Json figures = Json::object();
  for (std::size_t i = 0; i < design::kFigures.size(); ++i) figures[design::kFigures[i].name] = figure_json(o, i);
  Json variations = Json::array();
  for (const design::Variation& v : o.spec().variations) variations.push_back(title_of(v));
  Json json{{"format", "evenglow-tolerance/1"},
            {"version", core::version()},
            {"title", o.job.nominal.title},
            {"command", o.command},
            {"overrides", o.job.nominal.overrides},
            {"samples", o.run.samples.size()},
            {"photons", o.spec().photons},
            {"seed", o.spec().seed},
            {"photon_seed", o.job.nominal.trace.seed},
            {"common_numbers", o.spec().common_numbers},
            {"variations", std::move(variations)},
            {"limits", limits_json(o)}};
  if (o.summary.all) json["yield"] = yield_json(*o.summary.all);
  json["figures"] = std::move(figures);
  json["worst"] = o.summary.worst;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace evenglow::app

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <nlohmann/json.hpp>

#include "app/tolerance_run.h"
#include "core/base/error.h"
#include "core/config/json_depth.h"
#include "design/tolerance/figures.h"

namespace evenglow::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStateFormat = "evenglow-tolerance-state/1";

Json pairs_of(const std::vector<core::Estimate>& estimates) {
  Json list = Json::array();
  for (const core::Estimate& e : estimates) list.push_back({e.value, e.se});
  return list;
}

/// A number, or null for one that is none.
double number_of(const Json& node) {
  return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.get<double>();
}

std::vector<core::Estimate> estimates_of(const Json& list) {
  std::vector<core::Estimate> estimates;
  for (const Json& pair : list) estimates.push_back({number_of(pair.at(0)), number_of(pair.at(1))});
  if (estimates.size() != design::kFigures.size()) throw core::Error("it is of another version");
  return estimates;
}

void require(bool good, const char* fault) {
  if (!good) throw core::Error(fault);
}

/// Figures that a display of so many cells can have (`checked_figures` lets none through that is no number).
void check_figures(const std::vector<core::Estimate>& figures, std::size_t cells) {
  constexpr double kMost = 1e12;                             // cd/m2; the sun has 1.6e9
  const double rms = std::sqrt(static_cast<double>(cells));  // of all light in one cell
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const bool is_rms = i == 0;  // its square may come out negative, and has a sign then
    const bool is_luminance = std::string_view(design::kFigures[i].unit) != "%";
    const double most = is_rms ? rms : is_luminance ? kMost : 1.0 + 1e-9;
    const auto& [value, se] = figures[i];
    require(value >= (is_rms ? -rms : 0.0) && value <= most && se >= 0.0 && se <= kMost,
            "a figure of it is out of range");
  }
}

std::array<double, 2> pair_of(const Json& node) {
  return {number_of(node.at(0)), number_of(node.at(1))};
}

}  // namespace

std::string tolerance_state(const std::string& identity, const design::ToleranceSamples& run) {
  Json samples = Json::array();
  for (const design::SampleResult& s : run.samples)
    samples.push_back({{"parameters", s.parameters},
                       {"figures", pairs_of(s.figures)},
                       {"halves", {s.halves.nine, s.halves.thirteen}}});
  return Json{{"format", kStateFormat},
              {"identity", identity},
              {"reference", pairs_of(run.reference)},
              {"samples", std::move(samples)},
              {"maps", run.maps.numbers()}}
      .dump();
}

namespace {

design::ToleranceSamples samples_from(const std::string& object, const std::string& identity,
                                      const ToleranceBounds& bounds) {
  core::require_shallow_json(object);
  const Json node = Json::parse(object);
  if (node.at("format").get<std::string>() != kStateFormat) throw core::Error("it is of another version");
  if (node.at("identity").get<std::string>() != identity)
    throw core::Error("it is of another run (the run file or an option has changed)");
  design::ToleranceSamples run;
  run.reference = estimates_of(node.at("reference"));
  for (const Json& s : node.at("samples"))
    run.samples.push_back({s.at("parameters").get<std::vector<double>>(),
                           estimates_of(s.at("figures")),
                           {pair_of(s.at("halves").at(0)), pair_of(s.at("halves").at(1))}});
  require(run.samples.size() <= bounds.samples, "it has more samples than the run file");
  check_figures(run.reference, bounds.cells.size());
  for (const design::SampleResult& s : run.samples) {
    require(s.parameters.size() == bounds.parameters, "a sample of it has other parameters than the run file");
    check_figures(s.figures, bounds.cells.size());
  }
  const auto numbers = node.at("maps").get<std::vector<double>>();
  require(run.samples.empty() || run.maps.restore(bounds.cells, run.samples.size(), numbers), "it is of other cells");
  return run;
}

}  // namespace

design::ToleranceSamples read_tolerance_state(const std::string& object, const std::string& identity,
                                              const ToleranceBounds& bounds) {
  try {
    return samples_from(object, identity, bounds);
  } catch (const Json::exception& error) {
    throw core::Error(error.what());
  }
}

}  // namespace evenglow::app

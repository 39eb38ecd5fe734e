#include <array>
#include <limits>

#include <nlohmann/json.hpp>

#include "app/tolerance_run.h"
#include "core/base/error.h"
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

design::ToleranceSamples read_tolerance_state(const std::string& object, const std::string& identity,
                                              const core::CellGrid& cells) {
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
  const auto numbers = node.at("maps").get<std::vector<double>>();
  if (!run.samples.empty() && !run.maps.restore(cells, run.samples.size(), numbers))
    throw core::Error("it is of other cells");
  return run;
}

}  // namespace evenglow::app

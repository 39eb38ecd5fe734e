#include "design/engine/outer_design.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <fmt/core.h>
#include <nlopt.hpp>

#include "design/engine/stop_rule.h"

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;

constexpr double kPenalty = 0.5;
constexpr double kFirstStep = 0.25;
constexpr double kLastStep = 0.02;

/// Of a design that does not show that it keeps the bound: by how much its RMS passes it, or may pass it.
double excess_over(const core::Estimate& rms, double bound) {
  return std::max({0.0, rms.value - rms.se - bound, rms.se - bound});
}

OuterVariable read_variable(const ConfigNode& node) {
  OuterVariable variable;
  variable.key = node.text({"key", "path of a number in the run file, as in --set", std::nullopt, 200});
  const auto range = node.numbers({"range", "least and largest value, in the unit of the key", Range::any(), 2, 2});
  if (range.size() == 2) {
    variable.low = range[0];
    variable.high = range[1];
    if (!(range[0] < range[1])) node.fault_at("range", "must be two numbers, least < largest");
  }
  variable.whole = node.boolean({"whole", "only whole numbers (counts)", false});
  double middle = 0.5 * (variable.low + variable.high);
  if (variable.whole) middle = std::round(middle);
  variable.start =
      node.optional_number({"start", "value of the first design; left out: the middle", Range::any()}).value_or(middle);
  if (variable.start < variable.low || variable.start > variable.high) node.fault_at("start", "must lie in the range");
  if (variable.whole && variable.start != std::round(variable.start))
    node.fault_at("start", fmt::format("must be a whole number, got {}", variable.start));
  if (variable.key == "trace.seed") node.fault_at("key", "must not be the seed: the luckiest noise would win");
  return variable;
}

nlopt::algorithm algorithm_of(const std::string& name) {
  if (name == "bobyqa") return nlopt::LN_BOBYQA;
  if (name == "sbplx") return nlopt::LN_SBPLX;
  return nlopt::LN_COBYLA;
}

/// The search and what it has seen.
class Search {
 public:
  Search(const OuterModel& model, const OuterSpec& spec, std::vector<OuterResult> known,
         const std::function<void(const std::vector<OuterResult>&)>& observer)
      : model_(model), spec_(spec), known_(std::move(known)), observer_(observer) {}

  /// NLopt passes no exception on but its own: what fails waits here for `rethrow`.
  double merit_or_stop(const std::vector<double>& scaled) {
    try {
      return merit_at(scaled);
    } catch (const nlopt::forced_stop&) {
      throw;
    } catch (...) {
      failure_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  double merit_at(const std::vector<double>& scaled) {
    const std::vector<double> values = values_of(scaled);
    for (const OuterResult& result : results_) {
      if (result.values == values) return outer_merit(result, spec_.rms);  // rounded to a point that is known
    }
    if (spent()) throw nlopt::forced_stop();
    if (results_.size() < known_.size() && known_[results_.size()].values == values) {
      results_.push_back(known_[results_.size()]);
    } else {
      auto result = model_(values);
      if (!result) {
        interrupted_ = true;
        throw nlopt::forced_stop();
      }
      results_.push_back(std::move(*result));
      observer_(results_);
    }
    return outer_merit(results_.back(), spec_.rms);
  }

  std::vector<double> scaled_start() const {
    std::vector<double> x;
    x.reserve(spec_.variables.size());
    for (const OuterVariable& v : spec_.variables) x.push_back((v.start - v.low) / (v.high - v.low));
    return x;
  }
  bool interrupted() const { return interrupted_; }
  std::vector<OuterResult> take() { return std::move(results_); }

 private:
  std::vector<double> values_of(const std::vector<double>& scaled) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      const OuterVariable& v = spec_.variables[i];
      const double value = v.low + std::clamp(scaled[i], 0.0, 1.0) * (v.high - v.low);
      values.push_back(v.whole ? std::round(value) : value);
    }
    return values;
  }
  bool spent() const {
    double photons = 0.0;
    for (const OuterResult& result : results_) photons += static_cast<double>(result.photons);
    return static_cast<int>(results_.size()) >= spec_.evaluations || (spec_.photons > 0.0 && photons >= spec_.photons);
  }

  const OuterModel& model_;
  const OuterSpec& spec_;
  std::vector<OuterResult> known_;
  const std::function<void(const std::vector<OuterResult>&)>& observer_;
  std::vector<OuterResult> results_;
  bool interrupted_ = false;
  std::exception_ptr failure_;
};

}  // namespace

OuterSpec read_outer(const ConfigNode& root) {
  OuterSpec spec;
  const bool british = root.has("optimise");
  if (british && root.has("optimize")) root.fault_at("optimise", "must not stand beside optimize, got both");
  const auto nodes = root.maps(british ? "optimise" : "optimize", "scalar keys that evenglow optimize turns", 20);
  for (const ConfigNode& node : nodes) {
    OuterVariable variable = read_variable(node);
    const bool twice = std::any_of(spec.variables.begin(), spec.variables.end(),
                                   [&](const OuterVariable& other) { return other.key == variable.key; });
    if (twice) node.fault_at("key", "must not stand in the list twice, got " + variable.key);
    spec.variables.push_back(std::move(variable));
  }
  const ConfigNode node = root.map("optimizer", "how evenglow optimize searches");
  spec.method = node.choice(
      {"method", "search of NLopt, without derivatives", {"cobyla", "bobyqa", "sbplx"}, std::string(spec.method)});
  spec.evaluations = static_cast<int>(node.integer({"evaluations", "designs at most", 1, 10000, spec.evaluations}));
  spec.photons = static_cast<double>(
      node.count({"photons", "photons of all designs together; 0: not bounded", 0, 1'000'000'000'000'000, 0}));
  spec.rms = node.number({"rms", "noise-corrected RMS that must not be passed", {0, 1, true, false}, spec.rms});
  if (spec.method == "bobyqa" && spec.variables.size() == 1)
    node.fault_at("method", "must be cobyla or sbplx for a single key, got bobyqa");
  return spec;
}

double outer_merit(const OuterResult& result, double rms_bound) {
  const double excess = shows_bound(result.rms, rms_bound) ? 0.0 : excess_over(result.rms, rms_bound) / rms_bound;
  return -result.efficiency.value + kPenalty * excess;
}

std::size_t best_of(const std::vector<OuterResult>& results, double rms_bound) {
  const auto best = std::min_element(results.begin(), results.end(), [&](const OuterResult& a, const OuterResult& b) {
    return outer_merit(a, rms_bound) < outer_merit(b, rms_bound);
  });
  return static_cast<std::size_t>(best - results.begin());
}

std::optional<std::vector<OuterResult>> run_outer(
    const OuterModel& model, const OuterSpec& spec, std::vector<OuterResult> known,
    const std::function<void(const std::vector<OuterResult>&)>& observer) {
  Search search(model, spec, std::move(known), observer);
  nlopt::opt optimizer(algorithm_of(spec.method), static_cast<unsigned>(spec.variables.size()));
  optimizer.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                                 void* data) { return static_cast<Search*>(data)->merit_or_stop(x); },
                              &search);
  optimizer.set_lower_bounds(0.0);
  optimizer.set_upper_bounds(1.0);
  optimizer.set_initial_step(kFirstStep);
  optimizer.set_xtol_abs(kLastStep);
  optimizer.set_maxeval(20 * spec.evaluations);  // points that round to known ones cost nothing, but must end
  std::vector<double> x = search.scaled_start();
  double least = 0.0;
  try {
    optimizer.optimize(x, least);
  } catch (const nlopt::forced_stop&) {  // the budget is spent, or interrupted
  } catch (const nlopt::roundoff_limited&) {
  }
  search.rethrow();
  if (search.interrupted()) return std::nullopt;
  return search.take();
}

}  // namespace evenglow::design

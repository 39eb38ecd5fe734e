#include "tests/soak/soak.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include <fmt/core.h>
#include <unistd.h>

#include "app/key_explorer.h"
#include "app/run_file.h"
#include "core/base/error.h"
#include "core/config/config_node.h"
#include "tests/soak/run_generator.h"
#include "tests/support/temp_folder.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tests {
namespace {

constexpr std::size_t kBatches = 20;

std::size_t resident_bytes() {
  std::size_t size = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%zu %zu", &size, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Asks for a stop when the time is over.
class Patience {
 public:
  explicit Patience(double seconds)
      : watcher_([this, seconds](const std::stop_token& end) {
          std::unique_lock lock(mutex_);
          changed_.wait_for(lock, end, std::chrono::duration<double>(seconds), [&] { return end.stop_requested(); });
          if (!end.stop_requested()) over_.request_stop();
        }) {}

  std::stop_token token() const { return over_.get_token(); }

 private:
  std::stop_source over_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::jthread watcher_;
};

std::string refusal_fault(const core::ConfigError& error) {
  for (const core::Fault& fault : error.faults()) {
    if (fault.to_string().find('\n') != std::string::npos) return "a fault of more than one line";
  }
  return "";
}

core::Estimate sum_of(const core::Tally& tally) {
  return tally.weighted_total(std::vector<double>(tally.bins(), 1.0));
}

std::string health(const tracer::TraceResult& result) {
  const core::Estimate account = sum_of(result.energy);
  const double sent = static_cast<double>(result.photons);
  if (!(std::abs(account.value - sent) <= 1e-9 * sent + 20.0 * account.se))
    return fmt::format("the energy account holds {} of {} photons", account.value, sent);
  for (const core::Tally* tally : {&result.luminance, &result.energy, &result.angular}) {
    for (const core::Estimate& bin : tally->totals()) {
      if (!std::isfinite(bin.value) || !std::isfinite(bin.se)) return "a sum is no number";
    }
  }
  return "";
}

/// Of a mean that enough photons have made; false where too few did for its error to be known.
bool add_pull(const core::Estimate& a, const core::Estimate& b, std::vector<double>& pulls) {
  const double se = std::hypot(a.se, b.se), mean = 0.5 * (a.value + b.value);
  if (!(se > 0.0 && se < 0.1 * mean)) return false;
  pulls.push_back((a.value - b.value) / se);
  return true;
}

class Soak {
 public:
  explicit Soak(const SoakOptions& options) : options_(options) {}

  /// What was found, or empty.
  std::string trace_file(const std::string& yaml, SoakOutcome& outcome) const {
    std::optional<app::Run> run;
    try {
      auto document = core::ConfigDocument::parse(yaml, "soak.yaml");
      run = app::read_keys(document);
      document.finish();
    } catch (const core::ConfigError& error) {
      ++outcome.refused;
      return refusal_fault(error);
    }
    const Patience patience(options_.patience_s);
    const tracer::DensityField density = tracer::initial_density(run->backlight);
    const auto path = run->trace.path;
    const tracer::Scene scene = tracer::compile_scene(std::move(run->backlight));
    std::vector<tracer::TraceResult> results;
    for (const std::uint64_t seed : {run->trace.seed, run->trace.seed + 1000}) {
      tracer::TraceOptions trace_options;
      trace_options.photons = tracer::whole_batches(options_.photons, kBatches);
      trace_options.batches = kBatches;
      trace_options.key = {seed, 0, 0};
      trace_options.threads = 1;
      trace_options.stop = patience.token();
      trace_options.path = path;
      auto result = trace(scene, density, trace_options);
      if (!result) return fmt::format("took more than {} s", options_.patience_s);
      if (const std::string fault = health(*result); !fault.empty()) return fault;
      outcome.photons += result->photons;
      results.push_back(std::move(*result));
    }
    ++outcome.traced;
    const auto top = static_cast<std::size_t>(tracer::Side::kTop);
    // One of a file, as the two of one trace go together.
    if (!add_pull(sum_of(results[0].luminance), sum_of(results[1].luminance), outcome.pulls))
      add_pull(results[0].energy.total(top), results[1].energy.total(top), outcome.pulls);
    return "";
  }

 private:
  const SoakOptions& options_;
};

}  // namespace

double SoakOutcome::pull_mean() const {
  double sum = 0.0;
  for (const double pull : pulls) sum += pull;
  return pulls.empty() ? 0.0 : sum / static_cast<double>(pulls.size());
}

double SoakOutcome::pull_width() const {
  double squares = 0.0;
  for (const double pull : pulls) squares += pull * pull;
  return pulls.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(pulls.size()));
}

double SoakOutcome::growth() const {
  const auto quarter = static_cast<std::ptrdiff_t>(resident.size() / 4);
  if (quarter < 10) return 0.0;
  const auto begin = resident.begin();
  return static_cast<double>(*std::min_element(begin + 3 * quarter, resident.end())) -
         static_cast<double>(*std::min_element(begin + quarter, begin + 2 * quarter));
}

SoakOutcome soak(const SoakOptions& options, const std::function<bool(std::uint64_t)>& go_on) {
  SoakOutcome outcome;
  RunGenerator generator(app::explore_keys(), options.seed);
  const Soak one(options);
  for (std::uint64_t number = 0; go_on(outcome.traced); ++number) {
    const std::string yaml = generator.next();
    if (!options.kept_file.empty()) write_text(options.kept_file, yaml);
    const auto begin = std::chrono::steady_clock::now();
    std::string finding;
    try {
      finding = one.trace_file(yaml, outcome);
    } catch (const std::exception& error) {
      finding = error.what();
    }
    outcome.slowest_s =
        std::max(outcome.slowest_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    outcome.resident.push_back(resident_bytes());
    if (finding.empty()) continue;
    outcome.findings.push_back(fmt::format("file {}: {}", number, finding));
    if (options.found) options.found(number, yaml, finding);
  }
  return outcome;
}

}  // namespace evenglow::tests

#include "app/tolerance_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/engine/state_file.h"
#include "design/engine/traced_model.h"
#include "design/tolerance/figures.h"
#include "design/tolerance/half_traces.h"

namespace evenglow::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kSampleStream = 0x701EB;  // of the photons of the samples

/// The state on the disk: saved when a while has passed that makes its cost small, and when asked to.
class SavedState {
 public:
  SavedState(const RunContext& context, std::string identity) : context_(context), identity_(std::move(identity)) {}

  void save(const design::ToleranceSamples& run) {
    const auto begin = Clock::now();
    context_.check_lock();
    design::save_state(context_.checkpoint, tolerance_state(identity_, run));
    saved_ = Clock::now();
    cost_ = saved_ - begin;
  }
  void save_in_time(const design::ToleranceSamples& run) {
    const auto passed = Clock::now() - saved_;
    if (passed > std::chrono::seconds(2) && passed > 20 * cost_) save(run);
  }

 private:
  const RunContext& context_;
  std::string identity_;
  Clock::time_point saved_{};
  Clock::duration cost_{};
};

design::ToleranceSamples earlier_samples(const ToleranceJob& job, const RunContext& context,
                                         const std::string& identity) {
  design::ToleranceSamples run;
  if (!context.options.resume) {
    design::remove_state(context.checkpoint);  // of a run that is begun anew
    return run;
  }
  try {
    std::string note;
    const design::ToleranceSpec& spec = job.nominal.tolerance;
    const ToleranceBounds bounds{job.nominal.backlight.luminance.cells, design::parameter_names(spec).size(),
                                 static_cast<std::size_t>(spec.samples)};
    const auto read = [&](const std::string& object) { run = read_tolerance_state(object, identity, bounds); };
    if (design::load_state(context.checkpoint, read, note))
      context.progress.line(fmt::format("resumed after sample {}", run.samples.size()));
    if (!note.empty()) context.progress.line(note);
    return run;
  } catch (const core::Error& error) {
    throw core::ConfigError(
        core::Fault{"--resume", 0, 0, "", core::one_line(error.what()) + " (--overwrite begins anew)"});
  }
}

/// Traces of this run, with one bar for the photons of all samples.
class SampleTracer {
 public:
  SampleTracer(const RunContext& context, std::uint64_t all) : context_(context), all_(all) {}

  std::optional<design::Observation> trace(Run run, std::uint64_t photons, std::uint32_t stream, std::uint32_t step) {
    design::TracedModelOptions options;
    options.seed = run.trace.seed;
    options.stream = stream;
    options.batches = run.trace.batches;
    options.threads = context_.options.threads;
    options.stop = context_.stop;
    options.path = run.trace.path;
    options.ranks = context_.options.ranks;
    options.progress = [this](std::uint64_t done, std::uint64_t) { context_.progress.photons(done_ + done, all_); };
    const tracer::DensityField density = tracer::initial_density(run.backlight);
    run.backlight.angular.reset();  // no figure asks for them
    run.backlight.color = false;
    const tracer::Scene scene = tracer::compile_scene(std::move(run.backlight));
    const design::ForwardModel model = traced_model(scene, std::move(options));
    auto observation = model(density, photons, step);
    done_ += photons;
    return observation;
  }

 private:
  const RunContext& context_;
  std::uint64_t all_;
  std::uint64_t done_ = 0;
};

/// The figures, if the display is not dark.
std::vector<core::Estimate> checked_figures(const design::Observation& observation, const design::DesignSpec& spec,
                                            const std::string& what) {
  auto figures = figures_of(design::make_judgment(observation, spec));
  const auto is_finite = [](const core::Estimate& e) { return std::isfinite(e.value) && std::isfinite(e.se); };
  if (std::all_of(figures.begin(), figures.end(), is_finite)) return figures;
  throw core::Error(
      what + ": no light on a part of the display that is measured (more photons may help: " + "tolerance.photons)");
}

/// Each sample reads the run file and its data anew.
core::Error changed_underway(const ToleranceJob& job) {
  return core::Error(core::one_line(job.file.string()) +
                     ": the file, or one that it names, has changed while the samples were traced (--overwrite begins "
                     "anew)");
}

std::string told(const design::ToleranceSamples& run, int all) {
  const auto& f = run.samples.back().figures;
  return fmt::format("sample {} of {}: RMS {:.2f} %, uniformity {:.3f}, luminance {:.1f} cd/m2", run.samples.size(),
                     all, 100.0 * f[0].value, f[1].value, f[3].value);
}

/// Empty figures of the nominal design, if they are not known yet. False: interrupted.
bool trace_nominal(const ToleranceJob& job, std::uint64_t photons, SampleTracer& tracer,
                   design::ToleranceSamples& run) {
  Run nominal = read_run(job.file, job.options);
  set_density(nominal, job.density);
  const auto observation = tracer.trace(std::move(nominal), photons, 0, design::kJudgingStep);
  if (!observation) return false;
  run.reference = checked_figures(*observation, job.nominal.design, "the nominal design");
  return true;
}

}  // namespace

std::optional<design::ToleranceSamples> run_tolerance(const ToleranceJob& job, const RunContext& context) {
  const design::ToleranceSpec& spec = job.nominal.tolerance;
  const std::string identity = run_identity(job.nominal, context.work);
  design::ToleranceSamples run = earlier_samples(job, context, identity);
  SavedState state(context, identity);
  const std::uint64_t reference = spec.reference > 0 ? spec.reference : job.nominal.trace.photons;
  const auto left = static_cast<std::uint64_t>(spec.samples) - run.samples.size();
  SampleTracer tracer(context, left * spec.photons + (run.reference.empty() ? reference : 0));
  context.progress.begin(fmt::format("{} samples", spec.samples));
  if (run.reference.empty()) {
    if (!trace_nominal(job, reference, tracer, run)) return std::nullopt;
    state.save(run);
  }
  const int tenth = std::max(1, spec.samples / 10);
  while (static_cast<int>(run.samples.size()) < spec.samples) {
    const int number = static_cast<int>(run.samples.size()) + 1;
    ToleranceSample sample = make_sample(job, number);
    if (sample.run.file_text != job.nominal.file_text) throw changed_underway(job);
    const auto step = static_cast<std::uint32_t>(spec.common_numbers ? 0 : number);
    const auto observation = tracer.trace(std::move(sample.run), spec.photons, kSampleStream, step);
    if (!observation) {
      state.save(run);
      return std::nullopt;
    }
    auto figures = checked_figures(*observation, job.nominal.design, fmt::format("sample {}", number));
    run.samples.push_back({std::move(sample.parameters), std::move(figures),
                           design::half_traces(observation->luminance, observation->map.luminance.grid)});
    run.maps.add(observation->map);
    if (number % tenth == 0) context.progress.line(told(run, spec.samples));
    state.save_in_time(run);
  }
  if (run_identity(job.nominal, context.work) != identity) throw changed_underway(job);
  state.save(run);
  return run;
}

}  // namespace evenglow::app

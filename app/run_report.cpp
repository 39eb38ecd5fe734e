#include "app/run_report.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/section_paths.h"
#include "core/base/build_id.h"
#include "core/base/sha256.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/parallel/ranks.h"
#include "design/engine/design_loop.h"
#include "design/engine/traced_metrology.h"
#include "design/problem/color_bound.h"
#include "design/problem/target.h"
#include "design/report/processor.h"
#include "design/report/section_view.h"

namespace evenglow::app {
namespace {

using design::Report;

std::string estimator_text(const tracer::LuminanceReceiverSpec& luminance) {
  std::string cone =
      fmt::format("a cone of {:.3g} degrees (half angle) about the normal", luminance.cone / core::kRadPerDeg);
  if (luminance.polar > 0.0) {
    cone = fmt::format(
        "a cone of {:.3g} degrees (half angle) about the direction of polar angle {:.4g} and azimuth "
        "{:.4g} degrees",
        luminance.cone / core::kRadPerDeg, luminance.polar / core::kRadPerDeg, luminance.azimuth / core::kRadPerDeg);
  }
  if (!luminance.views.empty()) {
    cone = fmt::format("cones of {:.3g} degrees (half angle), the weighted sum of the directions",
                       luminance.cone / core::kRadPerDeg);
    for (const tracer::ViewDirection& view : luminance.views) {
      cone += fmt::format("{} {:.3g} x ({:.4g}, {:.4g}) degrees", &view == &luminance.views.front() ? "" : ",",
                          view.share, view.polar / core::kRadPerDeg, view.azimuth / core::kRadPerDeg);
    }
  }
  if (luminance.pupil) {
    const tracer::PupilSpec& pupil = *luminance.pupil;
    cone = fmt::format("a pupil of {:.4g} mm at a distance of {:.5g} mm before the point ({:.5g}, {:.5g}) mm",
                       pupil.diameter, pupil.distance, pupil.x, pupil.y);
  }
  if (luminance.estimator == tracer::LuminanceEstimator::kCounting) {
    return "Mean luminance in " + cone + ", by counting the photons that leave within it.";
  }
  return "Mean luminance in " + cone +
         ", as what each scatter is expected to send there through the films above (next-event estimate); light that "
         "takes other ways is counted.";
}

}  // namespace

Report describe_run(const Run& run, const RunContext& context) {
  Report report;
  report.version = core::version();
  report.build_id = core::build_id();
  report.title = run.title;
  report.variant = run.variant;
  report.command = context.command;
  report.run_file_text = run.file_text;
  report.run_file_sha256 = core::sha256_hex(run.file_text);
  report.overrides = run.overrides;
  report.seed = run.trace.seed;
  report.threads = core::effective_threads(context.options.threads);
  report.ranks = context.options.ranks != nullptr ? context.options.ranks->count() : 1;
  report.processor = design::processor_name();
  report.luminance_estimator = estimator_text(run.backlight.luminance);
  report.density_min = run.design.density_min;
  report.density_max = run.design.density_max;
  for (std::size_t i = 0; i < run.backlight.films.size(); ++i) {
    const tracer::Film& film = run.backlight.films[i];
    report.films.push_back({film.kind, film.axis / core::kRadPerDeg, film.gap, film.remarks});
    for (const std::string& remark : film.remarks) report.notes.push_back(film_note(i, report.films.back(), remark));
  }
  for (std::size_t i = 0; i < run.backlight.sources.size(); ++i) {
    const std::string note = run.backlight.sources[i]->note();
    if (!note.empty())
      report.notes.push_back(fmt::format("sources[{}] ({}): {}", i, run.backlight.source_kinds[i], note));
  }
  return report;
}

void take_observation(const tracer::Scene& scene, const design::DesignSpec& spec,
                      const design::Observation& observation, Report& report) {
  report.final = make_judgment(observation, spec);
  for (const design::ViewJudgment& view : report.final.views) {
    report.notes.push_back(
        fmt::format("Seen from the polar angle {:.4g} and the azimuth {:.4g} degrees alone (weight {:.3g}): RMS {:.2f} "
                    "+- {:.2f} %, "
                    "mean luminance {:.1f} +- {:.1f} cd/m2.",
                    view.polar_deg, view.azimuth_deg, view.share, 100.0 * view.rms_corrected.value,
                    100.0 * view.rms_corrected.se, view.luminance_mean.value, view.luminance_mean.se));
  }
  report.luminance = observation.map.luminance;
  report.luminance_se = observation.map.standard_error;
  const design::Target target(spec, observation.map.luminance.grid);
  if (!target.plain()) report.target = target.relative();
  report.energy = observation.energy;
  report.angular = observation.angular;
  report.angular_spots = observation.angular_spots;
  report.color = traced_color(scene, observation);
  report.hot_spots = traced_hot_spots(scene, observation);
  SectionOptions section;
  section.key = {report.seed, 0, 0};
  report.section_svg = design::section_svg(section_view(scene, {report.density}, section));
}

void tell_color(const design::DesignSpec& spec, Report& report) {
  if (!spec.goal.color || !report.color) return;
  const core::Estimate& color = report.color->rms_corrected;
  report.notes.push_back(design::color_verdict(color, *spec.goal.color));
  if (color.value > *spec.goal.color + 2.0 * color.se) report.stop_reason += "; the bound of the color is not kept";
}

void finish_timing(const Stopwatch& watch, Report& report) {
  double photons = static_cast<double>(report.final.photons);
  double cpu = 0.0;
  for (const design::StepRecord& step : report.steps) {
    photons += static_cast<double>(step.photons);
    cpu += step.cpu_s;
  }
  report.timing.wall_s = watch.wall_s();
  report.timing.cpu_s = std::max(watch.cpu_s(), cpu);
  report.timing.photons_per_cpu_s = report.timing.cpu_s > 0.0 ? photons / report.timing.cpu_s : 0.0;
}

}  // namespace evenglow::app

#include "app/dots_verify.h"

#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "app/dots_output.h"
#include "app/output_directory.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "design/report/number_format.h"
#include "tracer/scene/dots_file.h"

namespace evenglow::app {
namespace {

/// Why dots of this run cannot be traced; empty: they can.
std::string obstacle(const Run& run) {
  const std::string& kind = run.backlight.microstructure->shape.kind;
  if (kind == "v_groove")
    return "is for shapes that stand as dots (printed_dot, microlens, cone, pyramid), got kind: v_groove";
  if (run.design.goal.kind == "max_efficiency") return "is for the goals even and min_rms, got max_efficiency";
  if (kind == "printed_dot") return "";
  if (run.backlight.plate->end_thickness < run.backlight.plate->thickness)
    return "of shapes with a height needs a flat light_guide_plate, got a wedge";
  if (run.dots.footprint != tracer::usual_footprint(kind))
    return fmt::format("needs the footprint of the shape {} (dots.footprint), got another", kind);
  return "";
}

}  // namespace

void check_verify(const core::ConfigNode& root, const Run& run) {
  if (!run.design.verify_dots || !run.backlight.microstructure || !run.backlight.plate) return;
  const core::ConfigNode design = root.map("design", "how it is designed");
  const std::string reason = obstacle(run);
  if (!reason.empty()) return design.fault_at("verify", "dots " + reason);
  const double most = design::greatest_dot_density(run.dots, run.backlight.microstructure->shape.fill);
  if (!run.dots.accept_shortfall && most <= run.design.density_min) {
    design.fault_at("verify", fmt::format("dots needs dots that can hold the least density, {:g}; those of the map "
                                          "dots hold at most {:.3g}",
                                          run.design.density_min, most));
  }
  const tracer::Box& area = run.backlight.area;
  const design::FreeArea free({area.min.x(), area.max.x(), area.min.y(), area.max.y()}, run.dots.margins,
                              run.dots.rectangles, run.dots.circles);
  const core::ConfigNode dots = root.map("dots", "how the density becomes real dots");
  if (!(free.bounds().x1 > free.bounds().x0 && free.bounds().y1 > free.bounds().y0)) {
    dots.fault_at("margins", "must leave a part of the plate, got none");
  } else if (free.free_share(core::CellGrid::over(64, 64, area.min.x(), area.min.y(), area.max.x(), area.max.y()))
                 .max() <= 0.0) {
    dots.fault_at("keep_out", "must leave a part of the plate, got none");
  }
}

std::string keep_to_dots(Run& run) {
  if (!run.design.verify_dots || run.dots.accept_shortfall) return "";
  const double most = design::greatest_dot_density(run.dots, run.backlight.microstructure->shape.fill);
  if (most >= run.design.density_max) return "";
  std::string note =
      fmt::format("The upper limit of the density is {:.4g} in place of {:g}: the dots of the map dots hold no more.",
                  most, run.design.density_max);
  run.design.density_max = most;
  return note;
}

DotProof::DotProof(const Run& run)
    : input_(dots_input_of(run, run.file.string())),
      free_(free_area(input_)),
      fill_(run.backlight.microstructure->shape.fill),
      label_(label(run, "")) {
  if (!run.variant.empty()) input_.title += " (" + run.variant + ")";
}

bool DotProof::add_to(design::Report& report, const design::ForwardModel& model, const design::DesignSpec& spec,
                      std::uint64_t photons, const RunContext& context,
                      std::optional<design::VerifiedDots>& verified) const {
  const design::DotVerification job{
      model, spec, input_.spec, input_.plate, free_, fill_, photons, context.options.threads, context.stop};
  Progress& progress = context.progress;
  design::VerificationHooks hooks;
  hooks.begins = [&](int round) {
    progress.begin(label_ + (round < 0 ? std::string("dots, final trace") : fmt::format("dots, round {}", round)));
  };
  hooks.finished = [&](const design::DotsRound& round) {
    progress.line(fmt::format("{}dots, round {}: {} dots, RMS {} %, luminance {} of the density model", label_,
                              round.record.step, round.dots, design::measured(round.record.rms_corrected, 100.0),
                              design::measured(round.over_density)));
  };
  try {
    verified = verify_dots(job, {report.density}, report.final.luminance_mean, hooks);
  } catch (const core::ConfigError& error) {  // what the dots cannot be is seen when they are placed: the design stays
    const std::string reason = "The dots were not verified: " + core::one_line(error.faults().front().to_string());
    report.notes.push_back(reason);
    progress.line(label_ + reason);
    return true;
  }
  if (!verified) return false;
  report.dots = verified->judgment;
  progress.line(label_ + "dots: " + verified->judgment.stop_reason);
  return true;
}

void DotProof::write(const design::VerifiedDots& verified, const RunContext& context) const {
  if (context.options.helper || context.checkpoint.empty()) return;
  const design::DotsJudgment& judgment = verified.judgment;
  core::CellField coverage = judgment.density;
  for (double& value : coverage.values) value = std::min(1.0, value * fill_);
  const design::CoverageMap map(std::move(coverage), free_);
  const auto directory = context.checkpoint.parent_path();
  // Sizes that were corrected fill the cells of the display, not those of the density.
  const bool resized = judgment.chosen > 0 && input_.spec.mode != design::DotMode::spacing;
  check_is_no_link(directory / kDotsFolder);
  const auto told = write_dots({input_, free_, resized ? nullptr : &map, verified.placement, directory.string()},
                               directory / kDotsFolder, context.progress, context.options.threads);
  for (const std::string& warning : told->warnings) context.progress.line("warning: " + warning);
}

}  // namespace evenglow::app

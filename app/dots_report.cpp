#include "app/dots_report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/version.h"
#include "core/config/message_text.h"

namespace evenglow::app {
namespace {

using Json = nlohmann::ordered_json;

double um(double mm) {
  return mm / core::kMmPerUm;
}

const char* mode_name(design::DotMode mode) {
  return mode == design::DotMode::spacing ? "spacing" : mode == design::DotMode::lattice ? "lattice" : "both";
}

struct Sizes {
  double least = 0.0, mean = 0.0, greatest = 0.0;  // um
  std::size_t classes = 0;
};

Sizes sizes_of(const core::DotPattern& dots) {
  std::set<float> radii;
  double sum = 0.0;
  for (const core::Dot& dot : dots) {
    radii.insert(dot.radius);
    sum += static_cast<double>(dot.radius);
  }
  const auto diameter = [](double radius) { return std::round(2e4 * um(radius)) / 1e4; };
  return {diameter(*radii.begin()), diameter(sum / static_cast<double>(dots.size())), diameter(*radii.rbegin()),
          radii.size()};
}

Json cells_of(const design::CellErrors& cells) {
  return {{"worst_error_dots", cells.worst_dots},
          {"rms_error_dots", cells.rms_dots},
          {"rms_relative_error", cells.rms_relative},
          {"total_relative_error", cells.mean_relative},
          {"beyond_one_dot", cells.beyond_one}};
}

Json neighbors_of(const design::NeighborStatistics& n) {
  return {{"least_distance_um", um(n.least_distance)}, {"mean_distance_um", um(n.mean_distance)},
          {"least_gap_um", um(n.least_gap)},           {"overlapping_dots", n.overlaps},
          {"relative_mean", n.mean_relative},          {"relative_sd", n.sd_relative}};
}

Json spectrum_of(const design::PowerSpectrum& s) {
  Json radial = Json::array();
  for (std::size_t i = 0; i < s.radial.size(); ++i) {
    if (std::isfinite(s.radial[i])) radial.push_back({(static_cast<double>(i) + 0.5) * s.kBin, s.radial[i]});
  }
  return {{"windows", s.windows},
          {"low_power", s.low_power},
          {"peak_power", s.peak_power},
          {"peak_frequency", s.peak_frequency},
          {"direction_contrast", s.direction_contrast},
          {"radial", std::move(radial)}};
}

Json beat_of(const design::Beat& b) {
  return {{"grating", b.grating},
          {"order", {b.order_x, b.order_y}},
          {"period_mm", b.period},
          {"pattern_period_um", um(b.pattern_period)},
          {"pattern_amplitude", b.amplitude},
          {"contrast", b.contrast},
          {"seen_contrast", b.seen},
          {"visible", b.visible}};
}

Json moire_of(const DotsReport& report) {
  Json gratings = Json::array(), beats = Json::array();
  for (const design::Grating& g : report.input.gratings) {
    gratings.push_back({{"name", g.name},
                        {"pitch_um", {um(g.lines.pitch_x), um(g.lines.pitch_y)}},
                        {"angle_deg", g.lines.angle / core::kRadPerDeg}});
  }
  for (const design::Beat& beat : report.quality.beats) beats.push_back(beat_of(beat));
  return {{"gratings", std::move(gratings)},
          {"viewing_mm", report.input.spec.viewing_distance},
          {"visible", report.quality.has_visible_beat()},
          {"beats", std::move(beats)}};
}

}  // namespace

std::string dots_json(const DotsReport& report) {
  const auto& dots = report.placement.dots;
  const design::DotSpec& spec = report.input.spec;
  const Sizes sizes = sizes_of(dots);
  const design::RectangleZone& p = report.input.plate;
  Json json{{"format", "evenglow-dots/1"},
            {"version", core::version()},
            {"title", report.input.title},
            {"source", report.source},
            {"run_file", report.input.run_file},
            {"count", dots.size()},
            {"area_mm2", report.placement.area},
            {"footprint", spec.footprint == core::Footprint::round ? "round" : "square"},
            {"diameter_um",
             {{"least", sizes.least}, {"mean", sizes.mean}, {"greatest", sizes.greatest}, {"classes", sizes.classes}}},
            {"plate_mm", {p.x0, p.x1, p.y0, p.y1}}};
  if (report.quality.cells) {
    json["mode"] = mode_name(spec.mode);
    json["seed"] = spec.seed;
    json["gap_um"] = um(spec.gap);
    json["wanted_area_mm2"] = report.placement.wanted_area;
    json["removed"] = report.placement.removed;
    json["short_cells"] = report.placement.short_cells;
    json["cells"] = cells_of(*report.quality.cells);
  } else {
    json["ignored_entities"] = report.ignored;
  }
  const auto& d = report.quality.discrepancy;
  json["neighbors"] = neighbors_of(report.quality.neighbors);
  json["discrepancy"] = {{"limit", "squared L2 star discrepancy <= 0.13 N^-1.15"},
                         {"windows", d.windows},
                         {"dots_in_window", d.mean_count},
                         {"within_limit", d.accepted},
                         {"mean_over_limit", d.mean_ratio},
                         {"worst_over_limit", d.worst_ratio}};
  json["spectrum"] = spectrum_of(report.quality.spectrum);
  json["moire"] = moire_of(report);
  if (report.made_neighbors) {
    json["made"] = {{"area_mm2", report.made_area},
                    {"area_ratio", report.made_area / report.placement.area},
                    {"neighbors", neighbors_of(*report.made_neighbors)}};
  }
  json["warnings"] = dots_warnings(report);
  json["timing"] = {{"placement_s", report.placement_s},
                    {"placement_cpu_s", report.placement_cpu_s},
                    {"quality_s", report.quality_s},
                    {"files_s", report.files_s}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string dots_table(const DotsReport& report) {
  const auto& quality = report.quality;
  const Sizes sizes = sizes_of(report.placement.dots);
  std::string text = core::one_line(report.input.title.empty() ? report.source : report.input.title) + "\n";
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<21}{}\n", name, value);
  };
  line("dots", fmt::format("{} of {:g} to {:g} um, mean {:.4g}; {} size{}", report.placement.dots.size(), sizes.least,
                           sizes.greatest, sizes.mean, sizes.classes, sizes.classes == 1 ? "" : "s"));
  if (quality.cells) {
    line("area", fmt::format("{:.6g} mm2, wanted {:.6g}", report.placement.area, report.placement.wanted_area));
    line("cell error", fmt::format("at most {:.2f} dots, RMS {:.2f} dots = {:.2f} %", quality.cells->worst_dots,
                                   quality.cells->rms_dots, 100.0 * quality.cells->rms_relative));
  } else {
    line("area", fmt::format("{:.6g} mm2", report.placement.area));
  }
  line("least gap",
       fmt::format("{:.3f} um; nearest neighbor at {:.2f} +- {:.2f} of the hexagonal distance",
                   um(quality.neighbors.least_gap), quality.neighbors.mean_relative, quality.neighbors.sd_relative));
  line("discrepancy",
       fmt::format("{} of {} windows within 0.13 N^-1.15; mean {:.3f} of it", quality.discrepancy.accepted,
                   quality.discrepancy.windows, quality.discrepancy.mean_ratio));
  line("power spectrum",
       fmt::format("{:.3f} at low frequencies, peak {:.2f}, direction contrast {:.2f}", quality.spectrum.low_power,
                   quality.spectrum.peak_power, quality.spectrum.direction_contrast));
  const std::string against =
      report.input.gratings.empty() ? "no panel or prism film given"
      : quality.beats.empty()       ? "no beat: no part of the pattern is in step"
                              : fmt::format("strongest beat {:.3g} mm, contrast {:.3g} ({})", quality.beats[0].period,
                                            quality.beats[0].contrast, quality.beats[0].grating);
  line("moire", against);
  line("time", fmt::format("placement {:.1f} s ({:.1f} s CPU), figures {:.1f} s, files {:.1f} s", report.placement_s,
                           report.placement_cpu_s, report.quality_s, report.files_s));
  return text;
}

std::vector<std::string> dots_warnings(const DotsReport& report) {
  std::vector<std::string> warnings;
  constexpr std::size_t kMost = 5;
  for (const design::Beat& b : report.quality.beats) {
    if (!b.visible || warnings.size() >= kMost) continue;
    warnings.push_back(
        fmt::format("moire: the pattern's period of {:.4g} um beats with order ({}, {}) of {}: period {:.3g} mm, "
                    "contrast {:.2g} before any blur",
                    um(b.pattern_period), b.order_x, b.order_y, b.grating, b.period, b.contrast));
  }
  const auto& p = report.placement;
  if (p.short_cells > 0)
    warnings.push_back(
        fmt::format("{} cells ask for more than the limits hold and got the greatest coverage", p.short_cells));
  if (p.removed > 0) warnings.push_back(fmt::format("{} dots found no place with the least gap", p.removed));
  if (report.quality.cells && report.quality.cells->beyond_one > 0)
    warnings.push_back(fmt::format("{} cells miss their area by more than one dot", report.quality.cells->beyond_one));
  if (report.quality.neighbors.overlaps > 0)
    warnings.push_back(fmt::format("{} dots overlap another one", report.quality.neighbors.overlaps));
  if (report.made_neighbors && report.made_neighbors->overlaps > 0)
    warnings.push_back(fmt::format("{} dots as made overlap another one", report.made_neighbors->overlaps));
  return warnings;
}

}  // namespace evenglow::app

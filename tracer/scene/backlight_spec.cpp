#include "tracer/scene/backlight_spec.h"

#include <tuple>

#include <fmt/core.h>

#include "core/base/units.h"
#include "tracer/films/film_registry.h"
#include "tracer/microstructure/pattern_face.h"
#include "tracer/scene/cell_keys.h"
#include "tracer/scene/density_file.h"
#include "tracer/scene/dots_file.h"
#include "tracer/scene/plate_keys.h"
#include "tracer/scene/receiver_keys.h"
#include "tracer/sources/window_overlap.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

constexpr Range kLength = {0.1, 10000.0, false, false};
constexpr double kDefaultLength = 140.0;
constexpr double kDefaultWidth = 66.0;

/// The key `density_file`: the map takes the place of `density`, and its cells that of `cells`.
void read_density_map(const ConfigNode& node, MicrostructureSpec& spec) {
  const auto path = node.file({"density_file",
                               "density at the start as a map, in the form of density.csv or as a picture (PNG, TIFF; "
                               "black 0, white 1); its cells replace `cells`",
                               std::string()});
  if (path.empty()) return;
  const auto matrix = node.guarded("density_file", [&] { return read_density_file(path); });
  if (!matrix) return;
  spec.nx = matrix->nx;
  spec.ny = matrix->ny;
  spec.density_map = matrix->values;
}

void read_interpolation(const ConfigNode& node, MicrostructureSpec& spec) {
  const std::string kind =
      node.choice({"interpolation",
                   "of the density: constant within a cell, or bilinear between the centers of the "
                   "cells, sampled on the subcells of each cell, whose mean it keeps",
                   {"constant", "bilinear"},
                   "constant"});
  const auto subcells = static_cast<int>(
      node.integer({"subcells", "of interpolation bilinear: parts of a cell along x and along y", 2, 16, 4}));
  if (kind != "bilinear") {
    if (node.has("subcells")) node.fault_at("subcells", "belongs to interpolation bilinear, got it with constant");
    return;
  }
  constexpr double kMost = 4e6;
  const double parts = static_cast<double>(spec.nx) * spec.ny * subcells * subcells;
  if (parts > kMost) {
    node.fault_at("subcells", fmt::format("must not make more than {} parts of all cells, got {}", kMost, parts));
    return;
  }
  spec.subcells = subcells;
}

std::optional<MicrostructureSpec> read_microstructure(const ConfigNode& backlight,
                                                      const BacklightSpec& backlight_spec) {
  if (!backlight_spec.plate) {
    if (backlight.has("microstructure")) {
      backlight.fault_at("microstructure", "needs a light_guide_plate to stand on, got none");
      backlight.map("microstructure", "").mark_read();
    }
    return std::nullopt;
  }
  if (!backlight.has("microstructure")) return std::nullopt;
  const ConfigNode node = backlight.map("microstructure", "the pattern that throws the light out of the plate");
  MicrostructureSpec spec;
  spec.face = read_pattern_on_top(node) ? Side::kTop : Side::kBottom;
  std::tie(spec.nx, spec.ny) = read_cells(node, {96, 48});
  spec.density = node.number(
      {"density", "share of the area under microstructure at the start, every cell", Range::closed(0, 1), 0.1});
  read_density_map(node, spec);
  read_interpolation(node, spec);
  if (auto shape = microstructure_registry().make(node, "printed_dot")) spec.shape = std::move(*shape);
  const Box& area = backlight_spec.area;
  spec.dots = read_dots_file(node, spec.shape.kind, {area.min.x(), area.max.x(), area.min.y(), area.max.y()});
  const bool wedge = backlight_spec.plate->end_thickness < backlight_spec.plate->thickness;
  if (spec.dots && spec.subcells > 1) {
    node.fault_at("interpolation", "of a density needs one, got dots_file: the pattern itself");
  }
  if (spec.dots && wedge && spec.shape.kind != "printed_dot") {
    node.fault_at("dots_file", "of shapes with a height needs a flat light_guide_plate, got a wedge");
  }
  return spec;
}

void read_reflectors(const ConfigNode& backlight, BacklightSpec& spec) {
  const ConfigNode node =
      backlight.map("reflectors", "sheets behind and beside the plate; a side that is left out is open");
  for (int i = 0; i < kSides; ++i) {
    const ConfigNode sheet = node.map(side_name(static_cast<Side>(i)), "sheet at this side");
    if (sheet.present()) spec.reflectors[static_cast<std::size_t>(i)] = make_reflector(sheet);
  }
}

void read_films(const ConfigNode& backlight, BacklightSpec& spec) {
  for (const ConfigNode& node : backlight.maps("films", "films from the plate upwards", 50)) {
    if (auto film = film_registry().make(node)) spec.films.push_back(std::move(*film));
  }
}

double stack_top(const BacklightSpec& spec) {
  double z = spec.area.max.z();
  for (const Film& film : spec.films) z += film.gap + (film.sheet ? film.sheet->thickness : 0.0);
  return z;
}

void check_overlap(const ConfigNode& node, const Source& source, const BacklightSpec& spec) {
  for (std::size_t i = 0; i < spec.sources.size(); ++i) {
    const auto place = overlap(*spec.sources[i], source);
    if (!place) continue;
    return node.fault(
        fmt::format("its LEDs must not stand where those of sources[{}] are, got both at {:.6g} mm along the {} edge",
                    i, *place, side_name(source.side())));
  }
}

void read_sources(const ConfigNode& backlight, BacklightSpec& spec) {
  const auto nodes = backlight.maps("sources", "light sources", 100);
  if (nodes.empty()) backlight.fault_at("sources", "must list at least one source, got none");
  SourcePlace place{spec.area, stack_top(spec)};
  if (!spec.plate) place.box.max.z() = place.top;
  for (const ConfigNode& node : nodes) {
    const auto source = source_registry().make(node);
    const Spectrum spectrum = read_spectrum(node);
    if (!source) continue;
    if (source->kind == "led_row" && !spec.plate) {
      node.fault("an led_row needs a light_guide_plate to stand at, got none");
      continue;
    }
    if (spec.plate && spec.plate->end_thickness < spec.plate->thickness && source->side == Side::kRight) {
      node.fault("a wedge is lit at its thick end, left, or at front, back, bottom or top, got a source at the right");
      continue;
    }
    SourcePointer placed = source->place(place);
    check_overlap(node, *placed, spec);
    spec.sources.push_back(std::move(placed));
    spec.source_kinds.push_back(source->kind);
    spec.spectra.push_back(spectrum);
    const auto& reflector = spec.reflectors[static_cast<std::size_t>(source->side)];
    const bool stands_before_it = source->kind == "led_row" || source->kind == "ray_file";
    if (stands_before_it && reflector && reflector->gap < spec.sources.back()->gap()) {
      node.fault_at(
          "gap_mm",
          fmt::format(
              "must not be larger than that of the {} reflector ({} mm), got {} mm: the light would start behind it",
              side_name(source->side), reflector->gap, spec.sources.back()->gap()));
    }
  }
}

Box plate_box(const LightGuidePlateSpec& plate) {
  return {core::Vec3::Zero(), core::Vec3(plate.length, plate.width, plate.thickness)};
}

Box bare_area(const ConfigNode& backlight) {
  const ConfigNode size = backlight.map("size", "size of the backlight, if it has no plate");
  const double length = size.number({"length_mm", "length, along x", kLength, kDefaultLength});
  const double width = size.number({"width_mm", "width, along y", kLength, kDefaultWidth});
  return {core::Vec3::Zero(), core::Vec3(length, width, 0.0)};
}

}  // namespace

BacklightSpec read_backlight(const ConfigNode& backlight) {
  BacklightSpec spec;
  if (backlight.has("light_guide_plate")) {
    spec.plate = read_plate(backlight.map("light_guide_plate", "the clear plate; left out: none"));
    spec.area = plate_box(*spec.plate);
    if (backlight.has("size")) {
      backlight.fault_at("size", "must be left out where there is a light_guide_plate, whose length and width count");
      backlight.map("size", "size of the backlight, if it has no plate").mark_read();
    }
  } else {
    spec.area = bare_area(backlight);
  }
  spec.microstructure = read_microstructure(backlight, spec);
  read_reflectors(backlight, spec);
  read_films(backlight, spec);
  read_sources(backlight, spec);
  spec.wavelengths = static_cast<std::size_t>(backlight.integer(
      {"wavelengths", "at most so many wavelengths stand for the spectra of the sources", 1, 256, 24}));
  read_receivers(backlight, spec);
  return spec;
}

}  // namespace evenglow::tracer

#include "tracer/scene/backlight_spec.h"

#include <algorithm>
#include <set>

#include <fmt/core.h>

#include "core/base/units.h"
#include "tracer/films/film_registry.h"
#include "tracer/scene/density_file.h"
#include "tracer/scene/material_keys.h"
#include "tracer/sources/window_overlap.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

constexpr Range kLength = {0.1, 10000.0, false, false};
constexpr double kDefaultLength = 140.0;
constexpr double kDefaultWidth = 66.0;

LightGuidePlateSpec read_plate(const ConfigNode& node) {
  LightGuidePlateSpec plate;
  plate.length = node.number({"length_mm", "length, along x, away from the left edge", kLength, kDefaultLength});
  plate.width = node.number({"width_mm", "width, along y", kLength, kDefaultWidth});
  plate.thickness = node.number({"thickness_mm", "thickness", {0.01, 1000.0, false, false}, 0.6});
  plate.material = read_material(node);
  return plate;
}

std::pair<int, int> read_cells(const ConfigNode& node, std::pair<int, int> fallback) {
  const auto cells = node.numbers({"cells",
                                   "number of cells along x and along y",
                                   Range::closed(1, 4096),
                                   2,
                                   2,
                                   {{static_cast<double>(fallback.first), static_cast<double>(fallback.second)}}});
  if (cells.size() != 2) return fallback;
  for (const double n : cells) {
    if (n != static_cast<int>(n)) {
      node.fault_at("cells", fmt::format("must be whole numbers, got {}", n));
      return fallback;
    }
  }
  if (cells[0] * cells[1] > 1e6) {
    node.fault_at("cells", fmt::format("must not be more than 1000000 cells in all, got {}", cells[0] * cells[1]));
    return fallback;
  }
  return {static_cast<int>(cells[0]), static_cast<int>(cells[1])};
}

/// The key `density_file`: the map takes the place of `density`, and its cells that of `cells`.
void read_density_map(const ConfigNode& node, MicrostructureSpec& spec) {
  const auto path =
      node.file({"density_file", "density at the start as a map, in the form of density.csv; its cells replace `cells`",
                 std::string()});
  if (path.empty()) return;
  const auto matrix = node.guarded("density_file", [&] { return read_density_file(path); });
  if (!matrix) return;
  spec.nx = matrix->nx;
  spec.ny = matrix->ny;
  spec.density_map = matrix->values;
}

std::optional<MicrostructureSpec> read_microstructure(const ConfigNode& backlight, bool has_plate) {
  if (!has_plate) {
    if (backlight.has("microstructure")) {
      backlight.fault_at("microstructure", "needs a light_guide_plate to stand on, got none");
      backlight.map("microstructure", "").mark_read();
    }
    return std::nullopt;
  }
  if (!backlight.has("microstructure")) return std::nullopt;
  const ConfigNode node = backlight.map("microstructure", "the pattern that throws the light out of the plate");
  MicrostructureSpec spec;
  spec.face = read_side(node, {"face", "patterned face", {"bottom", "top"}, "bottom"});
  std::tie(spec.nx, spec.ny) = read_cells(node, {96, 48});
  spec.density = node.number(
      {"density", "share of the area under microstructure at the start, every cell", Range::closed(0, 1), 0.1});
  read_density_map(node, spec);
  if (auto shape = microstructure_registry().make(node, "printed_dot")) spec.shape = std::move(*shape);
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
    SourcePointer placed = source->place(place);
    check_overlap(node, *placed, spec);
    spec.sources.push_back(std::move(placed));
    spec.source_kinds.push_back(source->kind);
    spec.spectra.push_back(spectrum);
    const auto& reflector = spec.reflectors[static_cast<std::size_t>(source->side)];
    if (source->kind == "led_row" && reflector && reflector->gap < spec.sources.back()->gap()) {
      node.fault_at(
          "gap_mm",
          fmt::format(
              "must not be larger than that of the {} reflector ({} mm), got {} mm: the LEDs would stand behind it",
              side_name(source->side), reflector->gap, spec.sources.back()->gap()));
    }
  }
}

core::CellGrid active_area(const ConfigNode& node, const Box& area, std::pair<int, int> cells) {
  std::array<double, 4> margin{};
  const ConfigNode margins = node.map("margins", "border of the plate that the display does not show");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string key = std::string(side_name(static_cast<Side>(i))) + "_mm";
    margin[i] = margins.number({key, "width of the border at this side", Range::closed(0, 1000), 0.0});
  }
  const double x0 = area.min.x() + margin[0];
  const double x1 = area.max.x() - margin[1];
  const double y0 = area.min.y() + margin[2];
  const double y1 = area.max.y() - margin[3];
  if (x1 - x0 < 0.01 || y1 - y0 < 0.01) {
    margins.fault(fmt::format("must leave an active area, got {} mm x {} mm", x1 - x0, y1 - y0));
    return core::CellGrid::over(cells.first, cells.second, area.min.x(), area.min.y(), area.max.x(), area.max.y());
  }
  return core::CellGrid::over(cells.first, cells.second, x0, y0, x1, y1);
}

/// What the topmost scattering film sends to the viewer must not be shut off by a sheet above it, nor turned aside by a
/// prism film or a sheet that scatters in its bulk.
bool next_event_works(const BacklightSpec& spec) {
  if (spec.reflectors[static_cast<std::size_t>(Side::kTop)]) return false;
  const auto decides = [](const Film& film) {
    return film.surface ? film.surface->scatters() || film.surface->redirects() : film.sheet->scattering.has_value();
  };
  const auto top = std::find_if(spec.films.rbegin(), spec.films.rend(), decides);
  return top != spec.films.rend() && top->surface && top->surface->scatters() && !top->surface->redirects();
}

void read_luminance(const ConfigNode& node, BacklightSpec& spec) {
  const core::CellGrid& whole = spec.luminance.cells;
  spec.luminance.cells = active_area(node, spec.area, read_cells(node, {whole.nx, whole.ny}));
  spec.luminance.cone = node.number({"cone_deg", "half angle of the viewing cone about the display's normal",
                                     Range::closed(0.5, 90), spec.luminance.cone / core::kRadPerDeg});
  const std::string estimator =
      node.choice({"estimator",
                   "how the luminance is estimated: at the topmost scattering film, by counting, or what fits",
                   {"auto", "next_event", "counting"},
                   "auto"});
  if (estimator == "next_event" && spec.luminance.estimator == LuminanceEstimator::kCounting) {
    node.fault_at("estimator",
                  "next_event needs a film that scatters (diffuser or a dbef with a table), and above it neither a "
                  "prism film nor a "
                  "reflector at the top");
  }
  if (estimator == "counting") spec.luminance.estimator = LuminanceEstimator::kCounting;
}

/// What holds unless the run file says otherwise: the whole area in the cells of the pattern.
void default_luminance(BacklightSpec& spec) {
  const int nx = spec.microstructure ? spec.microstructure->nx : 96;
  const int ny = spec.microstructure ? spec.microstructure->ny : 48;
  spec.luminance.cells =
      core::CellGrid::over(nx, ny, spec.area.min.x(), spec.area.min.y(), spec.area.max.x(), spec.area.max.y());
  spec.luminance.estimator = next_event_works(spec) ? LuminanceEstimator::kNextEvent : LuminanceEstimator::kCounting;
}

void read_receivers(const ConfigNode& backlight, BacklightSpec& spec) {
  const auto nodes = backlight.maps("receivers", "what is measured; by default all three kinds", 10);
  std::set<std::string> seen;
  default_luminance(spec);
  for (const ConfigNode& node : nodes) {
    const std::string kind = node.choice(
        {"kind",
         "luminance: of each cell; flux: the energy account (always kept); angular: luminance by viewing direction; "
         "color: chromaticity of each cell of the luminance receiver",
         {"luminance", "flux", "angular", "color"},
         {}});
    if (!seen.insert(kind).second) node.fault(fmt::format("there must be one {} receiver at most, got another", kind));
    if (kind == "luminance") {
      read_luminance(node, spec);
    } else if (kind == "color") {
      spec.color = true;
    } else if (kind == "angular") {
      AngularReceiverSpec angular;
      angular.polar_count =
          static_cast<int>(node.integer({"polar_count", "bins of the polar angle from 0 to 90 degrees", 1, 180, 18}));
      angular.azimuth_count =
          static_cast<int>(node.integer({"azimuth_count", "bins of the azimuth from 0 to 360 degrees", 1, 360, 24}));
      spec.angular = angular;
    }
  }
  if (nodes.empty()) spec.angular = AngularReceiverSpec{};
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
  spec.microstructure = read_microstructure(backlight, spec.plate.has_value());
  read_reflectors(backlight, spec);
  read_films(backlight, spec);
  read_sources(backlight, spec);
  spec.wavelengths = static_cast<std::size_t>(backlight.integer(
      {"wavelengths", "at most so many wavelengths stand for the spectra of the sources", 1, 256, 24}));
  read_receivers(backlight, spec);
  return spec;
}

}  // namespace evenglow::tracer

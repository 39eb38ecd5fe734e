#include "design/tolerance/tolerance_spec.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/config/key_path.h"
#include "design/tolerance/figures.h"
#include "tracer/scene/density_file.h"

namespace evenglow::design {
namespace {

using core::ConfigNode;
using core::Range;
using Kind = VariationKind;

struct KindRow {
  const char* name;
  Kind kind;
  double most;  // spread, in the unit of the name
};

constexpr std::array<KindRow, 9> kKinds{{{"dot_growth_um", Kind::dot_growth, 1000.0},
                                         {"dot_size_um", Kind::dot_size, 1000.0},
                                         {"dot_place_um", Kind::dot_place, 10000.0},
                                         {"dot_region_um", Kind::dot_region, 1000.0},
                                         {"led_flux", Kind::led_flux, 0.3},
                                         {"led_along_mm", Kind::led_along, 100.0},
                                         {"led_height_mm", Kind::led_height, 100.0},
                                         {"film_angle_deg", Kind::film_angle, 90.0},
                                         {"key", Kind::key, 1e9}}};

const KindRow* row_of(const std::string& name) {
  for (const KindRow& row : kKinds) {
    if (name == row.name) return &row;
  }
  return nullptr;
}

bool is_of_dots(Kind kind) {
  return kind == Kind::dot_growth || kind == Kind::dot_size || kind == Kind::dot_place || kind == Kind::dot_region;
}

/// Dots that wander over many cells are no longer those of the design.
void check_place(const ConfigNode& node, const tracer::BacklightSpec& backlight, const Variation& variation) {
  const core::Vec3 size = backlight.area.max - backlight.area.min;
  const auto& cells = *backlight.microstructure;
  const double most = 250.0 * std::min(size.x() / cells.nx, size.y() / cells.ny);
  if (variation.distribution.spread <= most) return;
  node.fault_at("normal", fmt::format("must be at most {:.4g} um, a quarter of a cell of the density, got {:.6g}", most,
                                      variation.distribution.spread));
}

void read_film(const ConfigNode& node, const tracer::BacklightSpec& backlight, Variation& variation) {
  variation.film =
      static_cast<int>(node.integer({"film", "which film turns, counted from 0 as in films[0]", 0, 999, {}}));
  const auto films = static_cast<int>(backlight.films.size());
  if (node.has("film") && films == 0) node.fault_at("film", "must name a film of the backlight, which has none");
  if (films > 0 && variation.film >= films) {
    node.fault_at("film", fmt::format("must lie in [0, {}], as the backlight has {} films, got {}", films - 1, films,
                                      variation.film));
  }
}

void read_source(const ConfigNode& node, const tracer::BacklightSpec& backlight, Variation& variation) {
  const auto& kinds = backlight.source_kinds;
  variation.source = static_cast<int>(
      node.integer({"source", "which row of LEDs, counted from 0 as in sources[0]; -1: all", -1, 999, -1}));
  const auto index = static_cast<std::size_t>(std::max(0, variation.source));
  if (variation.source >= 0 && (index >= kinds.size() || kinds[index] != "led_row"))
    node.fault_at("source", fmt::format("must name a led_row of the backlight, got {}", variation.source));
  if (variation.source < 0 && std::find(kinds.begin(), kinds.end(), "led_row") == kinds.end())
    node.fault_at("kind", "must not vary LEDs, as the backlight has no led_row");
  const Distribution& d = variation.distribution;
  if (variation.kind == Kind::led_flux && !(d.least(1.0) > 0.0))
    node.fault(fmt::format("the factor on the flux must stay above 0, got one of {:.4g}", d.least(1.0)));
}

/// What gives a sample other cells, or a density that is replaced by that of the design.
constexpr const char* kKeysOfGrids[] = {"backlight.size",
                                        "backlight.light_guide_plate.length_mm",
                                        "backlight.light_guide_plate.width_mm",
                                        "backlight.microstructure.density",
                                        "backlight.microstructure.density_file",
                                        "backlight.microstructure.dots_file",
                                        "backlight.microstructure.cells",
                                        "backlight.microstructure.subcells",
                                        "backlight.receivers"};

bool is_below(const std::string& key, const std::string& parent) {
  return key == parent || key.starts_with(parent + '.') || key.starts_with(parent + '[');
}

void read_key(const ConfigNode& node, Variation& variation) {
  variation.key = node.text({"key", "path of a number in the run file, as in --set", std::nullopt, 200});
  variation.relative = node.boolean({"relative", "the spread is a share of the key's value", false});
  if (variation.relative && (node.has("choices") || node.has("mean")))
    node.fault_at("relative", "belongs to normal and uniform about the value of the file");
  if (node.has("key") && !core::parse_key_path(variation.key)) {
    node.fault_at("key", "must be the path of a key, as backlight.films[0].haze, got " + variation.key);
  } else if (!variation.key.starts_with("backlight.")) {
    node.fault_at("key", "must be a key of the backlight, got " + variation.key);
  }
  for (const char* grid : kKeysOfGrids) {
    if (!is_below(variation.key, grid)) continue;
    node.fault_at("key", fmt::format("must not be of {}, by which the samples would not have the cells and the density "
                                     "of the nominal design, got {}",
                                     grid, variation.key));
  }
}

/// Two variations of one number would not add: the later would take its place.
void check_once(const ConfigNode& node, const std::vector<Variation>& earlier, const Variation& variation) {
  const auto is = [](const Variation& v, Kind kind) { return v.kind == kind; };
  for (const Variation& other : earlier) {
    const bool twice = is(variation, Kind::key) && is(other, Kind::key) && variation.key == other.key;
    const auto taken_by = [&](const Variation& key, const Variation& kind) {
      if (!is(key, Kind::key)) return false;
      if (is(kind, Kind::film_angle)) return key.key == fmt::format("backlight.films[{}].axis_deg", kind.film);
      if (is(kind, Kind::led_flux)) return key.key.find(".flux_factors") != std::string::npos;
      const bool moved = is(kind, Kind::led_along) || is(kind, Kind::led_height);
      return moved && key.key.find("offsets_mm") != std::string::npos;
    };
    if (twice || taken_by(variation, other) || taken_by(other, variation))
      node.fault("must not vary what another variation varies, got " + title_of(variation) + " beside " +
                 title_of(other));
  }
}

Variation read_variation(const ConfigNode& node, const tracer::BacklightSpec& backlight) {
  std::vector<std::string> names;
  names.reserve(std::size(kKinds));
  for (const KindRow& row : kKinds) names.emplace_back(row.name);
  Variation variation;
  const auto kind = node.kind({"kind", "what varies, with the unit of its distribution", names});
  if (!kind) return variation;
  const KindRow& row = *row_of(*kind);
  variation.kind = row.kind;
  variation.name = row.name;
  const bool each_dot = row.kind == Kind::dot_size || row.kind == Kind::dot_place || row.kind == Kind::dot_region;
  if (each_dot) {
    variation.distribution.spread = read_deviation(node, row.most);
  } else {
    variation.distribution = read_distribution(node, row.most);
  }
  if (row.kind == Kind::dot_region)
    variation.length =
        node.number({"length_mm", "distance over which the growth is alike: its correlation has fallen to 0.61 there",
                     Range::closed(0.1, 10000), 20.0});
  if (is_of_dots(row.kind) && !backlight.microstructure)
    node.fault_at("kind", "must not vary dots, as the backlight has no microstructure");
  if (row.kind == Kind::dot_place && backlight.microstructure) check_place(node, backlight, variation);
  if (row.kind == Kind::film_angle) read_film(node, backlight, variation);
  if (row.kind == Kind::led_flux || row.kind == Kind::led_along || row.kind == Kind::led_height)
    read_source(node, backlight, variation);
  if (row.kind == Kind::key) read_key(node, variation);
  return variation;
}

std::vector<Limit> read_limits(const ConfigNode& tolerance) {
  const ConfigNode node = tolerance.map("limits", "bounds that a sample must keep to be fit for sale");
  std::vector<Limit> limits;
  for (const Figure& figure : kFigures) {
    const ConfigNode bounds = node.map(figure.name, std::string("bounds of the ") + figure.title);
    Limit limit{figure.name, {}, {}};
    limit.min = bounds.optional_number({"min", "must not be less", Range::closed(-1e9, 1e9)});
    limit.max = bounds.optional_number({"max", "must not be greater", Range::closed(-1e9, 1e9)});
    if (!node.has(figure.name)) continue;
    if (!limit.min && !limit.max) bounds.fault("must have min, max or both, got neither");
    if (limit.min && limit.max && *limit.min >= *limit.max)
      bounds.fault_at("min", fmt::format("must be less than max = {:.6g}, got {:.6g}", *limit.max, *limit.min));
    limits.push_back(std::move(limit));
  }
  return limits;
}

}  // namespace

std::string title_of(const Variation& variation) {
  switch (variation.kind) {
    case Kind::key:
      return variation.key;
    case Kind::film_angle:
      return fmt::format("{} of films[{}]", variation.name, variation.film);
    default:
      break;
  }
  return variation.source < 0 ? variation.name : fmt::format("{} of sources[{}]", variation.name, variation.source);
}

ToleranceSpec read_tolerance(const ConfigNode& root, const tracer::BacklightSpec& backlight) {
  const ConfigNode node = root.map("tolerance", "spread and yield in production (evenglow tolerance)");
  ToleranceSpec spec;
  spec.samples = static_cast<int>(node.integer({"samples", "backlights that are drawn", 10, 100000, spec.samples}));
  spec.seed = static_cast<std::uint64_t>(
      node.integer({"seed", "draws other samples; that of the photons is trace.seed", 0, 1LL << 62, 1}));
  spec.photons =
      static_cast<std::uint64_t>(node.count({"photons", "photons of each sample", 100, 1'000'000'000'000, 500'000}));
  spec.reference = static_cast<std::uint64_t>(
      node.count({"reference_photons", "photons of the nominal design; 0: as trace.photons", 0, 1'000'000'000'000, 0}));
  spec.common_numbers =
      node.boolean({"common_numbers", "trace every sample with the same random numbers", spec.common_numbers});
  const auto earlier = node.file_in(
      {"result", "directory of a design whose density is made; left out: what the microstructure says", std::string()},
      "density.csv");
  if (!earlier.empty()) {
    if (auto read = node.guarded("result", [&] { return tracer::read_density_file(earlier); }))
      spec.density = MapTable{std::move(*read)};
    if (!backlight.microstructure) node.fault_at("result", "must not be given for a backlight without microstructure");
  }
  spec.limits = read_limits(node);
  for (const ConfigNode& item : node.maps("variations", "what varies from sample to sample", 50)) {
    Variation variation = read_variation(item, backlight);
    check_once(item, spec.variations, variation);
    spec.variations.push_back(std::move(variation));
  }
  return spec;
}

}  // namespace evenglow::design

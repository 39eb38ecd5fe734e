#include "app/tolerance_job.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/config/key_path.h"
#include "core/config/message_text.h"
#include "design/report/number_format.h"
#include "tracer/scene/scene.h"

namespace evenglow::app {
namespace {

using core::ConfigDocument;
using core::ConfigNode;
using design::Variation;
using Kind = design::VariationKind;

std::string variation_path(std::size_t index) {
  return fmt::format("tolerance.variations[{}]", index);
}

/// The node at a path; none if the file has none there.
std::optional<ConfigNode> node_at(ConfigNode node, const std::string& path) {
  const auto steps = core::parse_key_path(path);
  if (!steps) return std::nullopt;
  for (const core::KeyStep& step : *steps) {
    std::optional<ConfigNode> next;
    if (step.is_index()) {
      const auto items = node.items();
      if (step.index < items.size()) next = items[step.index];
    } else if (node.is_map()) {
      for (auto& [name, child] : node.entries()) {
        if (name == step.key) next = child;
      }
    }
    if (!next) return std::nullopt;
    node = *next;
  }
  return node;
}

std::optional<double> number_at(const ConfigDocument& document, const std::string& path) {
  const auto node = node_at(document.root(), path);
  if (!node) return std::nullopt;
  const std::string text = node->yaml();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<double> list_at(const ConfigDocument& document, const std::string& path) {
  std::vector<double> values;
  const auto node = node_at(document.root(), path);
  if (!node) return values;
  for (std::size_t i = 0; i < node->items().size(); ++i)
    values.push_back(number_at(document, fmt::format("{}[{}]", path, i)).value_or(0.0));
  return values;
}

constexpr int kReadBefore = 50;  // samples, before the first photon

ConfigDocument changed_document(const Options& options) {
  ConfigDocument document = ConfigDocument::load(options.files.front());
  for (const auto& change : option_overrides(options)) document.apply(change);
  return document;
}

/// The values about which the samples vary.
void read_nominal(const ConfigDocument& document, ToleranceJob& job) {
  std::vector<core::Fault> faults;
  const auto& variations = job.nominal.tolerance.variations;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    const Variation& variation = variations[v];
    double value = variation.kind == Kind::led_flux ? 1.0 : 0.0;
    if (variation.kind == Kind::key) {
      const auto found = number_at(document, variation.key);
      const design::Distribution& d = variation.distribution;
      if (!found && !d.mean && d.choices.empty()) {
        faults.push_back({job.file.string(), 0, 0, variation_path(v) + ".key",
                          "must be given in the run file as a number to vary about (or with mean or choices), got " +
                              core::shown(variation.key)});
      }
      value = found.value_or(0.0);
    }
    job.values.values.push_back(value);
  }
  const tracer::BacklightSpec& backlight = job.nominal.backlight;
  for (std::size_t i = 0; i < backlight.sources.size(); ++i) {
    const bool row = backlight.source_kinds[i] == "led_row";
    job.values.leds.push_back(row ? static_cast<int>(backlight.sources[i]->windows().size()) : 0);
    const std::string path = fmt::format("backlight.sources[{}].", i);
    job.factors.push_back(list_at(document, path + "flux_factors"));
    job.along.push_back(list_at(document, path + "offsets_mm"));
    job.height.push_back(list_at(document, path + "height_offsets_mm"));
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
}

/// What the variations say of the LEDs of one source, over what the file says.
struct LedLists {
  std::vector<double> factors, along, height;
};

void apply(std::vector<double>& list, const std::vector<double>& drawn, std::size_t from, int count, bool multiply) {
  list.resize(static_cast<std::size_t>(count), multiply ? 1.0 : 0.0);
  for (std::size_t i = 0; i < list.size(); ++i)
    list[i] = multiply ? list[i] * drawn[from + i] : list[i] + drawn[from + i];
}

std::string yaml_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + design::shortest(value);
  return text + ']';
}

void add_led_changes(const ToleranceJob& job, const design::SampleDraws& draws,
                     std::vector<ConfigDocument::Override>& changes) {
  const auto& variations = job.nominal.tolerance.variations;
  std::vector<std::size_t> used(variations.size(), 0);  // numbers of each variation that earlier rows took
  for (std::size_t source = 0; source < job.values.leds.size(); ++source) {
    LedLists lists{job.factors[source], job.along[source], job.height[source]};
    std::string flux, along, height;  // origins
    for (std::size_t v = 0; v < variations.size(); ++v) {
      const Variation& variation = variations[v];
      const int count = job.values.leds[source];
      if (variation.source >= 0 && static_cast<std::size_t>(variation.source) != source) continue;
      const auto take = [&](std::vector<double>& list, std::string& origin, bool multiply) {
        apply(list, draws[v], used[v], count, multiply);
        used[v] += static_cast<std::size_t>(count);
        origin = variation_path(v);
      };
      if (count == 0) continue;
      if (variation.kind == Kind::led_flux) take(lists.factors, flux, true);
      if (variation.kind == Kind::led_along) take(lists.along, along, false);
      if (variation.kind == Kind::led_height) take(lists.height, height, false);
    }
    const std::string path = fmt::format("backlight.sources[{}].", source);
    if (!flux.empty()) changes.push_back({path + "flux_factors", yaml_of(lists.factors), flux});
    if (!along.empty()) changes.push_back({path + "offsets_mm", yaml_of(lists.along), along});
    if (!height.empty()) changes.push_back({path + "height_offsets_mm", yaml_of(lists.height), height});
  }
}

/// An axis in [0, 180): one turned by half a turn is the same.
double turned(double degrees) {
  const double rest = std::fmod(degrees, 180.0);
  const double axis = rest < 0.0 ? rest + 180.0 : rest;
  return axis < 180.0 ? axis : 0.0;
}

/// The changes of the run file that a sample stands for; its dots are not among them.
std::vector<ConfigDocument::Override> changes_of(const ToleranceJob& job, const design::SampleDraws& draws,
                                                 const ConfigDocument& document) {
  std::vector<ConfigDocument::Override> changes;
  const auto& variations = job.nominal.tolerance.variations;
  std::vector<double> turns(job.nominal.backlight.films.size(), 0.0);
  for (std::size_t v = 0; v < variations.size(); ++v) {
    const Variation& variation = variations[v];
    if (variation.kind == Kind::key)
      changes.push_back({variation.key, design::shortest(draws[v].front()), variation_path(v)});
    if (variation.kind != Kind::film_angle) continue;
    const auto film = static_cast<std::size_t>(variation.film);
    const std::string path = fmt::format("backlight.films[{}].axis_deg", film);
    turns[film] += draws[v].front();
    changes.push_back(
        {path, design::shortest(turned(number_at(document, path).value_or(0.0) + turns[film])), variation_path(v)});
  }
  add_led_changes(job, draws, changes);
  return changes;
}

Run changed_run(const ToleranceJob& job, const design::SampleDraws& draws) {
  const ConfigDocument document = changed_document(job.options);
  Run run = read_point(job.file, {}, job.options, Purpose::kTrace, changes_of(job, draws, document));
  const auto cells_of = [](const Run& one) {
    const auto& pattern = one.backlight.microstructure;
    return std::tuple(one.backlight.luminance.cells, pattern ? pattern->nx : 0, pattern ? pattern->ny : 0);
  };
  if (cells_of(run) != cells_of(job.nominal)) {
    throw core::ConfigError(core::Fault{job.file.string(), 0, 0, "tolerance.variations",
                                        "must leave the cells of display and density as they are, got a change"});
  }
  return run;
}

}  // namespace

void set_density(Run& run, const core::CellField& density) {
  if (run.backlight.microstructure) run.backlight.microstructure->density_map = density.values;
}

ToleranceJob read_tolerance_job(const Options& options) {
  ToleranceJob job;
  job.file = options.files.front();
  job.options = options;
  job.nominal = read_run(job.file, options);
  const design::ToleranceSpec& spec = job.nominal.tolerance;
  if (spec.variations.empty()) {
    throw core::ConfigError(core::Fault{job.file.string(), 0, 0, "tolerance.variations",
                                        "must be a list of {kind: led_flux, normal: 0.05} and the like, got nothing"});
  }
  const ConfigDocument document = changed_document(options);
  if (varies_dots(spec) && node_at(document.root(), "backlight.microstructure.dots_file")) {
    throw core::ConfigError(core::Fault{job.file.string(), 0, 0, "tolerance.variations",
                                        "must not vary the dots of a dots_file, which are traced one by one: what "
                                        "varies is their density (leave dots_file out)"});
  }
  read_nominal(document, job);
  job.density = tracer::initial_density(job.nominal.backlight).cells;
  if (!spec.density.empty()) job.density = spec.density.over(job.density.grid);
  set_density(job.nominal, job.density);
  if (job.nominal.backlight.microstructure)
    job.dots = design::dot_model(job.density, job.nominal.backlight.microstructure->shape.fill, job.nominal.dots);
  for (const bool greatest : {false, true}) changed_run(job, design::extreme_sample(spec, job.values, greatest));
  // Of several numbers each may be allowed, and some of them together not.
  for (int number = 1; number <= std::min(spec.samples, kReadBefore); ++number)
    changed_run(job, design::draw_sample(spec, job.values, number));
  return job;
}

ToleranceSample make_sample(const ToleranceJob& job, int number) {
  const design::ToleranceSpec& spec = job.nominal.tolerance;
  const design::SampleDraws draws = design::draw_sample(spec, job.values, number);
  ToleranceSample sample{changed_run(job, draws), {}};
  std::vector<core::CellField> growth;
  core::CellField density = job.density;
  if (design::varies_dots(spec)) {
    design::SampleDots dots = design::draw_dots(spec, draws, number, job.density, job.dots);
    density = std::move(dots.density);
    growth = std::move(dots.growth);
  }
  set_density(sample.run, density);
  sample.parameters = design::parameters_of(spec, draws, growth);
  return sample;
}

}  // namespace evenglow::app

#include "bench/verdicts.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace evenglow::bench {
namespace {

struct Spread {
  double median, least, most;
};

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

std::string bar_of(const Line& line) {
  if (line.at_most) return fmt::format("<= {:g}", *line.at_most);
  if (line.at_least) return fmt::format(">= {:g}", *line.at_least);
  return "";
}

std::string verdict_of(const Line& line, double value) {
  if (!line.at_most && !line.at_least) return "";
  const bool met = line.at_most ? value <= *line.at_most : value >= *line.at_least;
  return met ? "met" : "MISSED";
}

void for_each_measured(const Measurements& measurements,
                       const std::function<void(const Line&, const std::vector<double>&)>& visit) {
  for (const Line& line : lines()) {
    const auto found = measurements.find({line.benchmark, line.counter});
    if (found != measurements.end() && !found->second.empty()) visit(line, found->second);
  }
}

}  // namespace

const std::vector<Line>& lines() {
  static const std::vector<Line> kLines = {
      {"S1: R, one raw intersection", "slab_walk", "R_ns", "ns"},
      {"S1: an event", "slab_walk", "event_ns", "ns"},
      {"S1: an event", "slab_walk", "event_per_R", "R", 2.0},
      {"S1: photons", "slab_walk", "photons_per_s", "1/s"},
      {"S1: events of a photon", "slab_walk", "events_per_photon", ""},
      {"S2 without prisms: R, one raw intersection", "film_walk", "R_ns", "ns"},
      {"S2 without prisms: an event, counted", "film_walk_counting", "event_per_R", "R", 2.0},
      {"S2 without prisms: an event, next-event", "film_walk", "event_per_R", "R"},
      {"S2 without prisms: photons, next-event", "film_walk", "photons_per_s", "1/s"},
      {"S2 without prisms: events of a photon", "film_walk", "events_per_photon", ""},
      {"S1 planar: an event", "slab_planar", "event_ns", "ns"},
      {"S1 planar: an event", "slab_planar", "event_per_R", "R", 0.25},
      {"S1 planar: photons", "slab_planar", "photons_per_s", "1/s"},
      {"S1 planar: gain over the general path", "slab_planar", "gain", "x"},
      {"S2 planar: an event, counted luminance", "prism_planar_counting", "event_per_R", "R"},
      {"S2 general: an event, counted luminance", "prism_planar_counting", "general_event_per_R", "R"},
      {"S2: events of a photon, prism facets left out", "prism_planar_counting", "events_per_photon", ""},
      {"S2 planar: photons, counted luminance", "prism_planar_counting", "photons_per_s", "1/s"},
      {"S2 planar: gain, counted luminance", "prism_planar_counting", "gain", "x", {}, 3.0},
      {"S2 planar: photons, with the next-event estimate", "prism_planar", "photons_per_s", "1/s"},
      {"S2 planar: gain, with the next-event estimate", "prism_planar", "gain", "x", {}, 3.0},
      {"  no prisms: an event, counted luminance", "film_planar_counting", "event_per_R", "R"},
      {"  no prisms: photons, counted luminance", "film_planar_counting", "photons_per_s", "1/s"},
      {"  no prisms: gain, counted luminance", "film_planar_counting", "gain", "x"},
      {"  no prisms: photons, next-event estimate", "film_planar", "photons_per_s", "1/s"},
      {"  no prisms: gain, next-event estimate", "film_planar", "gain", "x"},
      {"bare slab planar: photons", "bare_slab_planar", "photons_per_s", "1/s", {}, 2e6},
      {"bare slab planar: gain", "bare_slab_planar", "gain", "x"},
      {"S1 with 1e6 dots, planar: an event", "slab_dots", "planar_event_per_R", "R", 2.0},
      {"S1 with 1e6 dots, general: an event", "slab_dots", "general_event_per_R", "R"},
      {"S1 with 1e6 dots, planar: over the density", "slab_dots", "over_density", "x"},
      {"S1 with 1e6 dots: photons", "slab_dots", "photons_per_s", "1/s"},
      {"1e6 dots: memory of a dot", "slab_dots", "bytes_per_dot", "B", 150.0},
      {"1e6 dots: is a place anywhere under a dot?", "dot_lookup", "lookup_per_R", "R", 2.0},
      {"S1 wavefront: an event", "slab_wavefront", "event_ns", "ns"},
      {"S1 wavefront: an event", "slab_wavefront", "event_per_R", "R"},
      {"S1 wavefront: photons", "slab_wavefront", "photons_per_s", "1/s"},
      {"S1 wavefront: gain over the scalar planar path", "slab_wavefront", "gain_planar", "x"},
      {"S1 wavefront: gain over the general path", "slab_wavefront", "gain", "x"},
      {"  same over planar, by SSE4", "slab_wavefront_by_set", "SSE4", "x"},
      {"  by AVX2", "slab_wavefront_by_set", "AVX2", "x"},
      {"  by AVX-512", "slab_wavefront_by_set", "AVX3", "x"},
      {"bare slab wavefront: photons", "bare_slab_wavefront", "photons_per_s", "1/s"},
      {"bare slab wavefront: gain over planar", "bare_slab_wavefront", "gain_planar", "x"},
      {"S2 wavefront, counted: gain over planar", "film_wavefront", "gain_planar", "x"},
      {"S2 wavefront, counted: gain over general", "film_wavefront", "gain", "x"},
      {"S2 with prism films, wavefront: over planar", "prism_wavefront", "gain_planar", "x"},
      {"S2 with prism films, wavefront: over general", "prism_wavefront", "gain", "x", {}, 12.0},
      {"cost of polarization, S1 planar", "slab_planar_polarization", "polarized_per_unpolarized", "x", 1.10},
      {"cost of polarization outside the DBEF, S2 planar", "prism_planar_polarization", "polarized_per_unpolarized",
       "x", 1.35},
      {"one sample: smooth face", "sample_smooth_face", "sample_per_R", "R"},
      {"one sample: white sheet", "sample_white_sheet", "sample_per_R", "R"},
      {"one sample: mirror", "sample_mirror", "sample_per_R", "R"},
      {"one sample: diffuser", "sample_diffuser", "sample_per_R", "R"},
      {"one sample: DBEF, table", "sample_tabulated_dbef", "sample_per_R", "R"},
      {"one sample: DBEF, ideal", "sample_ideal_dbef", "sample_per_R", "R"},
      {"one sample: LPP", "sample_lpp", "sample_per_R", "R"},
      {"luminance: gain of next-event over counting, S1", "luminance_estimators_slab", "gain", "x", {}, 40.0},
      {"luminance: difference of the two, S1", "luminance_estimators_slab", "difference_se", "s.e."},
      {"same with crossed prism films: gain", "luminance_estimators_prisms", "gain", "x"},
      {"same with crossed prism films: difference", "luminance_estimators_prisms", "difference_se", "s.e."},
      {"luminance: gain of next-event over counting", "luminance_estimators", "gain", "x", {}, 40.0},
      {"luminance: difference of the two", "luminance_estimators", "difference_se", "s.e."},
      {"same, ideal DBEF: gain", "luminance_estimators_ideal", "gain", "x", {}, 40.0},
      {"same, ideal DBEF: difference", "luminance_estimators_ideal", "difference_se", "s.e."},
      {"cost of polarization, S1", "slab_polarization", "polarized_per_unpolarized", "x", 1.25},
      {"cost of polarization, S2 without prisms", "film_polarization", "polarized_per_unpolarized", "x", 1.35},
      {"S1, planar: a photon", "growth_base", "planar_us", "us"},
      {"  1 cell", "growth_cells_1", "planar_us", "us"},
      {"  1e6 cells", "growth_cells_1e6", "planar_us", "us"},
      {"  1 mm thick", "growth_thickness_1", "planar_us", "us"},
      {"  0.3 mm thick", "growth_thickness_03", "planar_us", "us"},
      {"  a tenth of the density", "growth_density_tenth", "planar_us", "us"},
      {"  twice the density", "growth_density_double", "planar_us", "us"},
      {"  diffuser", "growth_films_1", "planar_us", "us"},
      {"  diffuser, prism film", "growth_films_2", "planar_us", "us"},
      {"  diffuser, 2 prism films, ideal DBEF", "growth_films_4", "planar_us", "us"},
      {"S1, general: a photon", "growth_base", "general_us", "us"},
      {"  1 cell", "growth_cells_1", "general_us", "us"},
      {"  1e6 cells", "growth_cells_1e6", "general_us", "us"},
      {"  1 mm thick", "growth_thickness_1", "general_us", "us"},
      {"  0.3 mm thick", "growth_thickness_03", "general_us", "us"},
      {"  a tenth of the density", "growth_density_tenth", "general_us", "us"},
      {"  twice the density", "growth_density_double", "general_us", "us"},
      {"  diffuser", "growth_films_1", "general_us", "us"},
      {"  diffuser, prism film", "growth_films_2", "general_us", "us"},
      {"  diffuser, 2 prism films, ideal DBEF", "growth_films_4", "general_us", "us"},
      {"CPU time of a photon, all threads over one", "threads", "cpu_ratio_all", "x", 1.10},
  };
  return kLines;
}

std::string table_text(const Measurements& measurements) {
  std::string text =
      fmt::format("{:<46}{:>12} {:<5}{:>24}  {:<9}{}\n", "what", "median", "", "least ... most", "bar", "verdict");
  for_each_measured(measurements, [&](const Line& line, const std::vector<double>& values) {
    const Spread s = spread_of(values);
    text += fmt::format("{:<46}{:>12.4g} {:<5}{:>24}  {:<9}{}\n", line.what, s.median, line.unit,
                        fmt::format("{:.4g} ... {:.4g}", s.least, s.most), bar_of(line), verdict_of(line, s.median));
  });
  return text;
}

std::string table_json(const Measurements& measurements) {
  auto rows = nlohmann::json::array();
  for_each_measured(measurements, [&](const Line& line, const std::vector<double>& values) {
    const Spread s = spread_of(values);
    nlohmann::json row = {{"what", line.what}, {"benchmark", line.benchmark}, {"counter", line.counter},
                          {"unit", line.unit}, {"median", s.median},          {"least", s.least},
                          {"most", s.most},    {"repetitions", values.size()}};
    if (line.at_most) row["at_most"] = *line.at_most;
    if (line.at_least) row["at_least"] = *line.at_least;
    if (line.at_most || line.at_least) row["met"] = verdict_of(line, s.median) == "met";
    rows.push_back(std::move(row));
  });
  return nlohmann::json{{"table", std::move(rows)}}.dump(2) + "\n";
}

}  // namespace evenglow::bench

#include "tracer/scene/receiver_keys.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/base/units.h"
#include "tracer/optics/lobe_width.h"
#include "tracer/scene/cell_keys.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;
using core::Range;

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

/// Is there something that scatters light towards the viewer over at least this angle (rad), on a level that paths from
/// the viewer reach?
bool next_event_works(const BacklightSpec& spec, double least_lobe) {
  const auto scatters = [&](const Bsdf& surface) { return surface.scatters() && spreads_over(surface, least_lobe); };
  if (spec.reflectors[static_cast<std::size_t>(Side::kTop)]) return false;
  for (const Film& film : std::views::reverse(spec.films)) {
    if (film.surface && scatters(*film.surface)) return true;
    // Little gets through it unscattered, and what it scatters is counted.
    if (film.sheet && film.sheet->scattering) return false;
  }
  const bool level_bottom = !spec.plate || spec.plate->thickness == spec.plate->end_thickness;
  const auto& bottom = spec.reflectors[static_cast<std::size_t>(Side::kBottom)];
  if (level_bottom && bottom && scatters(*bottom->surface)) return true;
  if (!spec.microstructure || (spec.microstructure->face == Side::kBottom && !level_bottom)) return false;
  constexpr double kAnyIndex = 1.5;
  const auto& optics = spec.microstructure->shape.optics;  // empty after a fault of its kind
  return optics && optics(kAnyIndex)->scatters();
}

constexpr double kLeastCounted = 0.5;  // degrees

/// A scatter whose lobe is narrower than the viewing cone is seldom joined to the viewer, and then heavily: counting
/// has the better figure of merit (docs/explain_estimator.md).
void choose_estimator(BacklightSpec& spec, const std::string& estimator) {
  LuminanceReceiverSpec& luminance = spec.luminance;
  constexpr double kWidest = 60.0 * core::kRadPerDeg;
  const bool countable = !luminance.pupil && luminance.cone >= kLeastCounted * core::kRadPerDeg;
  luminance.least_lobe = estimator == "auto" && countable ? std::min(luminance.cone, kWidest) : 0.0;
  const bool works = estimator != "counting" && next_event_works(spec, luminance.least_lobe);
  luminance.estimator = works ? LuminanceEstimator::kNextEvent : LuminanceEstimator::kCounting;
}

struct Direction {
  double polar = 0.0, azimuth = 0.0;  ///< rad
};

/// `cone`: half angle of the cone about it, rad.
Direction read_direction(const ConfigNode& node, double cone, bool required) {
  std::optional<std::vector<double>> usual = std::vector<double>{0.0, 0.0};
  if (required) usual.reset();
  const auto direction = node.numbers({"direction_deg",
                                       "direction of view, the axis of the cone: polar angle from the normal, azimuth "
                                       "from +x towards +y",
                                       Range::closed(-360, 360), 2, 2, usual});
  if (direction.size() != 2) return {};
  const double polar = direction[0] / core::kRadPerDeg;
  const double half = cone / core::kRadPerDeg;
  constexpr double kHorizon = 89.0;
  if (polar < 0.0) {
    node.fault_at("direction_deg", fmt::format("the polar angle must not be negative, got {:.6g}", polar));
    return {};
  }
  if (polar > 0.0 && polar + half > kHorizon + 1e-9) {
    node.fault_at("direction_deg", fmt::format("the polar angle and the cone's half angle ({:.6g} degrees) must not be "
                                               "more than {} degrees together, got {:.6g}",
                                               half, kHorizon, polar + half));
    return {};
  }
  return {direction[0], direction[1]};
}

/// Several directions whose weighted sum is the luminance that counts.
void read_views(const ConfigNode& node, BacklightSpec& spec) {
  constexpr std::size_t kMostViews = 9;
  const auto nodes =
      node.maps("views", "several directions of view: the luminance that counts is their weighted sum", kMostViews);
  if (nodes.empty()) return;
  for (const char* key : {"direction_deg", "pupil"}) {
    if (node.has(key)) node.fault_at(key, "must be left out beside views, got both");
  }
  double sum = 0.0;
  for (const ConfigNode& view : nodes) {
    const Direction direction = read_direction(view, spec.luminance.cone, true);
    const double weight = view.number(
        {"weight", "of this direction in the sum; only ratios of weights matter", Range::positive(1e6), 1.0});
    spec.luminance.views.push_back({direction.polar, direction.azimuth, weight});
    sum += weight;
  }
  for (ViewDirection& view : spec.luminance.views) view.share /= sum;
}

/// Where the viewer's eye or camera is. A pupil decides the direction of view by itself.
void read_pupil(const ConfigNode& node, BacklightSpec& spec) {
  const ConfigNode pupil = node.map("pupil", "pupil of an eye or a camera before the display, instead of a cone");
  if (!pupil.present()) return;
  for (const char* key : {"cone_deg", "direction_deg"}) {
    if (node.has(key)) node.fault_at(key, "must be left out beside a pupil, got both");
  }
  const core::CellGrid& area = spec.luminance.cells;
  PupilSpec read;
  read.distance = pupil.number({"distance_mm", "from the top of the backlight", Range::closed(10, 100000), {}});
  read.diameter = pupil.number({"diameter_mm", "of the pupil", Range::closed(0.1, 1000), {}});
  const auto at = pupil.numbers({"at",
                                 "the pupil is before this point x, y (mm); by default the center of the active area",
                                 Range::closed(-100000, 100000),
                                 2,
                                 2,
                                 {{area.x0 + 0.5 * area.nx * area.dx, area.y0 + 0.5 * area.ny * area.dy}}});
  read.x = at[0];
  read.y = at[1];
  spec.luminance.pupil = read;
}

void read_luminance(const ConfigNode& node, BacklightSpec& spec) {
  const core::CellGrid& whole = spec.luminance.cells;
  spec.luminance.cells = active_area(node, spec.area, read_cells(node, {whole.nx, whole.ny}));
  spec.luminance.cone = node.number({"cone_deg", "half angle of the viewing cone; 0: one direction, not for counting",
                                     Range::closed(0, 90), spec.luminance.cone / core::kRadPerDeg});
  const Direction direction = read_direction(node, spec.luminance.cone, false);
  spec.luminance.polar = direction.polar;
  spec.luminance.azimuth = direction.azimuth;
  read_views(node, spec);
  read_pupil(node, spec);
  const std::string estimator =
      node.choice({"estimator",
                   "how the luminance is estimated: as what each scatter is expected to send to the viewer, by "
                   "counting, or what fits",
                   {"auto", "next_event", "counting"},
                   "auto"});
  choose_estimator(spec, estimator);
  if (estimator == "next_event" && spec.luminance.estimator == LuminanceEstimator::kCounting) {
    node.fault_at("estimator",
                  "next_event needs something that scatters (a diffuser, a dbef with a table, printed dots, a white "
                  "bottom), and above it neither a sheet that scatters in its bulk nor a reflector at the top");
  }
  const double cone = spec.luminance.cone / core::kRadPerDeg;
  if (!spec.luminance.pupil && spec.luminance.estimator == LuminanceEstimator::kCounting && cone < kLeastCounted) {
    node.fault_at("cone_deg",
                  fmt::format("must be at least {:g} where photons are counted, got {:g}", kLeastCounted, cone));
  }
}

void read_angular(const ConfigNode& node, BacklightSpec& spec) {
  AngularReceiverSpec angular;
  angular.polar_count =
      static_cast<int>(node.integer({"polar_count", "bins of the polar angle from 0 to 90 degrees", 1, 180, 18}));
  angular.azimuth_count =
      static_cast<int>(node.integer({"azimuth_count", "bins of the azimuth from 0 to 360 degrees", 1, 360, 24}));
  const std::string at = node.choice({"at",
                                      "all: over the whole area; center, 9, 13: also at spots of the active area",
                                      {"all", "center", "9", "13"},
                                      "all"});
  angular.spots = at == "all" ? 0 : at == "center" ? 1 : std::stoi(at);
  const core::CellGrid& area = spec.luminance.cells;
  const double width = area.nx * area.dx, height = area.ny * area.dy;
  const double largest = 0.2 * std::min(width, height);  // then no spots overlap, and none sticks out
  const double usual = std::min(0.08 * std::hypot(width, height), largest);
  const double spot = node.number({"spot_mm", "diameter of a spot", Range::positive(2000.0), usual});
  if (spot > largest * (1.0 + 1e-9)) {
    node.fault_at("spot_mm", fmt::format("must be at most a fifth of the shorter side of the active area ({:.6g} mm), "
                                         "got {:.6g} mm",
                                         largest, spot));
  }
  angular.spot_radius = 0.5 * spot;
  constexpr int kMostBins = 100000;
  if (angular.spots > 0 && angular.polar_count * angular.azimuth_count * (angular.spots + 1) > kMostBins) {
    node.fault_at("at", fmt::format("must not make more than {} bins in all, got {} for each of {} spots", kMostBins,
                                    angular.polar_count * angular.azimuth_count, angular.spots));
  }
  spec.angular = angular;
}

/// What holds unless the run file says otherwise: the whole area in the cells of the pattern.
void default_luminance(BacklightSpec& spec) {
  const int nx = spec.microstructure ? spec.microstructure->nx : 96;
  const int ny = spec.microstructure ? spec.microstructure->ny : 48;
  spec.luminance.cells =
      core::CellGrid::over(nx, ny, spec.area.min.x(), spec.area.min.y(), spec.area.max.x(), spec.area.max.y());
  choose_estimator(spec, "auto");
}

}  // namespace

void read_receivers(const ConfigNode& backlight, BacklightSpec& spec) {
  const auto nodes = backlight.maps("receivers", "what is measured; by default all three kinds", 10);
  std::set<std::string> seen;
  default_luminance(spec);
  const ConfigNode* angular = nullptr;
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
      angular = &node;
    }
  }
  if (angular != nullptr) read_angular(*angular, spec);  // its spots lie in the active area of the luminance receiver
  if (nodes.empty()) spec.angular = AngularReceiverSpec{};
}

}  // namespace evenglow::tracer

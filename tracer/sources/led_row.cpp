#include "tracer/sources/led_row.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "tracer/optics/opaque_reflector.h"
#include "tracer/sources/led_tolerances.h"
#include "tracer/sources/pattern_keys.h"

namespace evenglow::tracer {
namespace {

struct LedRowKeys {
  Side edge = Side::kLeft;
  int count = 12;
  std::optional<double> pitch;  // mm
  double width = 2.6;           // mm
  double height = 0.4;          // mm
  double gap = 0.05;            // mm
  double flux = 9.0;            // lm, of each LED
  EmissionPattern pattern = EmissionPattern::cosine_power(1.0);
  double reflectance = 0.5;
  LedToleranceKeys tolerances;
};

class LedRow final : public Source {
 public:
  LedRow(const LedRowKeys& keys, const Box& plate)
      : keys_(keys),
        axes_(side_axes(keys.edge)),
        surface_(keys.reflectance, 0.0),
        tolerances_(draw_tolerances(keys.tolerances, keys.count, keys.flux)) {
    const int a = keys.edge == Side::kLeft || keys.edge == Side::kRight ? 1 : 0;
    const double length = plate.max[a] - plate.min[a];
    pitch_ = keys.pitch.value_or(length / keys.count);
    first_along_ = 0.5 * (plate.min[a] + plate.max[a]) - 0.5 * pitch_ * (keys.count - 1);
    center_z_ = 0.5 * (plate.min.z() + plate.max.z());
    plane_ = core::Vec3::Zero();
    plane_[axis_of(keys.edge)] = plate.plane(keys.edge) + (is_upper(keys.edge) ? keys.gap : -keys.gap);
    flux_ = keys.flux * keys.count;
    if (tolerances_.fluxes.empty()) return;
    flux_ = 0.0;
    for (const double flux : tolerances_.fluxes) cumulative_.push_back(flux_ += flux);
  }

  double flux() const override { return flux_; }
  std::string note() const override { return pattern_note(keys_.pattern); }
  Side side() const override { return keys_.edge; }
  double gap() const override { return keys_.gap; }
  const Bsdf* window_surface() const override { return &surface_; }

  std::vector<SourceWindow> windows() const override {
    std::vector<SourceWindow> result;
    for (int i = 0; i < keys_.count; ++i) {
      const double along = place(i), z = height(i);
      result.push_back(
          {along - 0.5 * keys_.width, along + 0.5 * keys_.width, z - 0.5 * keys_.height, z + 0.5 * keys_.height});
    }
    return result;
  }

  Photon emit(core::PhotonRng& rng) const override {
    const int led = choose(rng.uniform());
    const double along = place(led) + (rng.uniform() - 0.5) * keys_.width;
    const double z = height(led) + (rng.uniform() - 0.5) * keys_.height;
    const core::Vec3 k = keys_.pattern.sample(rng, axes_);
    Photon photon;
    photon.quad = led;
    photon.position = plane_ + along * axes_.a + z * axes_.b;
    photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    return photon;
  }

 private:
  /// Middle of an LED along the edge (mm).
  double place(int led) const {
    const double even = first_along_ + pitch_ * led;
    return tolerances_.offsets.empty() ? even : even + tolerances_.offsets[static_cast<std::size_t>(led)];
  }

  /// Middle of an LED across the edge (mm).
  double height(int led) const {
    return tolerances_.heights.empty() ? center_z_ : center_z_ + tolerances_.heights[static_cast<std::size_t>(led)];
  }

  /// An LED by its flux; a dark one never.
  int choose(double u) const {
    if (cumulative_.empty()) return std::min(static_cast<int>(u * keys_.count), keys_.count - 1);
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u * flux_);
    const auto last = std::lower_bound(cumulative_.begin(), cumulative_.end(), flux_);
    return static_cast<int>(std::min(found, last) - cumulative_.begin());
  }

  LedRowKeys keys_;
  SideAxes axes_;
  OpaqueReflector surface_;
  LedTolerances tolerances_;
  std::vector<double> cumulative_;  // lm, up to and with each LED; empty: all alike
  double flux_ = 0.0;               // lm, of the row
  double pitch_ = 0.0;
  double first_along_ = 0.0;
  double center_z_ = 0.0;
  core::Vec3 plane_;
};

/// LEDs that were shifted one by one must not reach each other, nor stick out of the edge.
void check_shifts(const core::ConfigNode& node, const LedRowKeys& keys, double length, double thickness) {
  constexpr double kSlack = 1e-9;
  const auto shift = [&](int led) {
    return keys.tolerances.offsets.empty() ? 0.0 : keys.tolerances.offsets[static_cast<std::size_t>(led)];
  };
  const double pitch = keys.pitch.value_or(length / keys.count);
  const double reach = kToleranceCut * keys.tolerances.position_spread;  // of what the seed draws besides
  const double row = pitch * (keys.count - 1) + keys.width;
  double room = 0.5 * (length - row) + shift(0);
  room = std::min(room, 0.5 * (length - row) - shift(keys.count - 1)) - reach;
  for (int i = 1; i < keys.count; ++i)
    room = std::min(room, pitch + shift(i) - shift(i - 1) - keys.width - 2.0 * reach);
  if (!keys.tolerances.offsets.empty() && room < -kSlack) {
    node.fault_at(
        "offsets_mm",
        fmt::format("must leave the LEDs beside each other on the edge, got a shift that is {:.4g} mm too far", -room));
  }
  const double above = 0.5 * (thickness - keys.height);
  for (const double height : keys.tolerances.heights) {
    if (std::abs(height) <= above + kSlack) continue;
    node.fault_at("height_offsets_mm",
                  fmt::format("must keep the LED within the plate's thickness (at most {:.4g} mm), got {:.6g} mm",
                              std::max(0.0, above), height));
    break;
  }
}

void check_fits(const core::ConfigNode& node, const LedRowKeys& keys, const Box& plate) {
  const int a = keys.edge == Side::kLeft || keys.edge == Side::kRight ? 1 : 0;
  const double length = plate.max[a] - plate.min[a];
  const double thickness = plate.max.z() - plate.min.z();
  const double pitch = keys.pitch.value_or(length / keys.count);
  const double row = pitch * (keys.count - 1) + keys.width;
  constexpr double kSlack = 1e-9;
  const char* edge = side_name(keys.edge);
  if (keys.height > thickness + kSlack) {
    node.fault_at("size_mm", fmt::format("the LED must not be higher than the plate ({:.6g} mm), got {:.6g} mm",
                                         thickness, keys.height));
  }
  if (keys.width > length + kSlack) {
    node.fault_at("size_mm", fmt::format("the LED must not be wider than the {} edge ({:.6g} mm), got {:.6g} mm", edge,
                                         length, keys.width));
  } else if (keys.count * keys.width > length + kSlack) {
    node.fault_at("count",
                  fmt::format("{} LEDs of {:.6g} mm must not be longer side by side than the {} edge ({:.6g} mm), got "
                              "{:.6g} mm",
                              keys.count, keys.width, edge, length, keys.count * keys.width));
  } else if (keys.count > 1 && keys.width > pitch + kSlack) {
    node.fault_at("pitch_mm", fmt::format("the pitch must not be less than the LED's width ({:.6g} mm), got {:.6g} mm",
                                          keys.width, pitch));
  } else if (row > length + kSlack) {
    node.fault_at("pitch_mm",
                  fmt::format("the row of {} LEDs must not be longer than the {} edge ({:.6g} mm), got {:.6g} mm",
                              keys.count, edge, length, row));
  } else if (keys.tolerances.position_spread > 0.0) {
    // Whatever the seed, no LED may reach its neighbor or stick out.
    const double reach = kToleranceCut * keys.tolerances.position_spread;
    const double between = keys.count > 1 ? 0.5 * (pitch - keys.width) : length;
    const double room = std::min(between, 0.5 * (length - row));
    if (reach > room + kSlack) {
      node.fault_at("position_spread_mm", fmt::format("must be at most {:.4g} mm, a third of the room beside each LED, "
                                                      "got {:.6g} mm",
                                                      room / kToleranceCut, keys.tolerances.position_spread));
    }
  }
  check_shifts(node, keys, length, thickness);
}

}  // namespace

SourceSpec make_led_row(const core::ConfigNode& node) {
  using core::Range;
  LedRowKeys keys;
  keys.edge =
      read_side(node, {"edge", "edge of the plate that the row stands at", {"left", "right", "front", "back"}, "left"});
  keys.count = static_cast<int>(node.integer({"count", "number of LEDs", 1, 10000, 12}));
  keys.pitch = node.optional_number(
      {"pitch_mm", "distance from LED to LED; default: the edge shared evenly", Range::positive(10000)});
  const std::vector<double> size =
      node.numbers({"size_mm",
                    "emitting window: width along the edge, height in the plate's thickness",
                    Range::positive(1000),
                    2,
                    2,
                    {{2.6, 0.4}}});
  if (size.size() == 2) {
    keys.width = size[0];
    keys.height = size[1];
  }
  keys.gap = node.number({"gap_mm", "air between window and plate", {0.001, 100.0, false, false}, 0.05});
  keys.pattern = read_emission_pattern(node);
  keys.flux = node.number({"flux_lm", "luminous flux of each LED; default: that of a pattern_file in cd, else 9",
                           Range::positive(1e6), 9.0});
  if (!node.has("flux_lm")) keys.flux = keys.pattern.flux().value_or(keys.flux);
  keys.tolerances = read_led_tolerances(node, keys.count);
  keys.reflectance =
      node.number({"reflectance", "reflectance of the window for light that comes back to it, Lambertian",
                   Range::closed(0, 1), 0.5});
  return {"led_row", keys.edge, [node, keys](const SourcePlace& place) -> SourcePointer {
            check_fits(node, keys, place.box);
            return std::make_unique<LedRow>(keys, place.box);
          }};
}

}  // namespace evenglow::tracer

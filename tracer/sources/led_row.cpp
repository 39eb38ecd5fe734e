#include "tracer/sources/led_row.h"

#include <fmt/core.h>

#include "core/math/sampling.h"
#include "tracer/optics/opaque_reflector.h"

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
  double exponent = 1.0;
  double reflectance = 0.5;
};

class LedRow final : public Source {
 public:
  LedRow(const LedRowKeys& keys, const Box& plate)
      : keys_(keys), axes_(side_axes(keys.edge)), surface_(keys.reflectance, 0.0) {
    const int a = keys.edge == Side::kLeft || keys.edge == Side::kRight ? 1 : 0;
    const double length = plate.max[a] - plate.min[a];
    pitch_ = keys.pitch.value_or(length / keys.count);
    first_along_ = 0.5 * (plate.min[a] + plate.max[a]) - 0.5 * pitch_ * (keys.count - 1);
    center_z_ = 0.5 * (plate.min.z() + plate.max.z());
    plane_ = core::Vec3::Zero();
    plane_[axis_of(keys.edge)] = plate.plane(keys.edge) + (is_upper(keys.edge) ? keys.gap : -keys.gap);
  }

  double flux() const override { return keys_.flux * keys_.count; }
  Side side() const override { return keys_.edge; }
  double gap() const override { return keys_.gap; }
  const Bsdf* window_surface() const override { return &surface_; }

  std::vector<SourceWindow> windows() const override {
    std::vector<SourceWindow> result;
    for (int i = 0; i < keys_.count; ++i) {
      const double along = first_along_ + pitch_ * i;
      result.push_back({along - 0.5 * keys_.width, along + 0.5 * keys_.width, center_z_ - 0.5 * keys_.height,
                        center_z_ + 0.5 * keys_.height});
    }
    return result;
  }

  Photon emit(core::PhotonRng& rng) const override {
    const int led = std::min(static_cast<int>(rng.uniform() * keys_.count), keys_.count - 1);
    const double along = first_along_ + pitch_ * led + (rng.uniform() - 0.5) * keys_.width;
    const double z = center_z_ + (rng.uniform() - 0.5) * keys_.height;
    const double u = rng.uniform();
    const core::Vec3 local = core::sample_cosine_power(u, rng.uniform(), keys_.exponent);
    Photon photon;
    photon.quad = led;
    photon.position = plane_ + along * axes_.a + z * axes_.b;
    const core::Vec3 k = local.x() * axes_.a + local.y() * axes_.b + local.z() * axes_.inward;
    photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    return photon;
  }

 private:
  LedRowKeys keys_;
  SideAxes axes_;
  OpaqueReflector surface_;
  double pitch_ = 0.0;
  double first_along_ = 0.0;
  double center_z_ = 0.0;
  core::Vec3 plane_;
};

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
  }
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
  keys.flux = node.number({"flux_lm", "luminous flux of each LED", Range::positive(1e6), 9.0});
  const std::string pattern =
      node.choice({"pattern", "angular pattern of the intensity", {"lambertian", "cosine_power"}, "lambertian"});
  if (pattern == "cosine_power") {
    keys.exponent = node.number({"exponent", "n of the intensity cos^n", Range::closed(0.1, 1000), 1.0});
  }
  keys.reflectance =
      node.number({"reflectance", "reflectance of the window for light that comes back to it, Lambertian",
                   Range::closed(0, 1), 0.5});
  return {"led_row", keys.edge, [node, keys](const SourcePlace& place) -> SourcePointer {
            check_fits(node, keys, place.box);
            return std::make_unique<LedRow>(keys, place.box);
          }};
}

}  // namespace evenglow::tracer

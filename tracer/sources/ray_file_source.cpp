#include "tracer/sources/ray_file_source.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tracer/sources/ray_sampler.h"

namespace evenglow::tracer {
namespace {

using core::Range;
using core::Vec3;

struct RayFileKeys {
  std::filesystem::path file;  // empty: at fault
  RayFileLayout layout;
  RayFlux rays;
  RayFileAxis axis = RayFileAxis::kPlusZ;
  Side face = Side::kLeft;
  double turn = 0.0;           // rad
  Vec3 origin = Vec3::Zero();  // mm, in the frame whose z points into the backlight
  int count = 1;
  std::optional<double> pitch;   // mm
  std::vector<double> at;        // mm; empty: count and pitch
  std::optional<double> across;  // mm
  double gap = 0.02;             // mm
  double flux = 1.0;             // lm, of each place
};

class RayFileSource final : public Source {
 public:
  RayFileSource(const RayFileKeys& keys, std::vector<Vec3> places)
      : face_(keys.face),
        gap_(keys.gap),
        flux_(keys.flux * static_cast<double>(places.size())),
        places_(std::move(places)),
        origin_(keys.origin),
        left_out_(keys.rays.backward / (keys.rays.forward + keys.rays.backward)),
        sampler_(keys.file, keys.layout, keys.axis, keys.rays) {
    const SideAxes axes = side_axes(keys.face);
    const Vec3 x = axes.b.cross(axes.inward);
    frame_.col(0) = std::cos(keys.turn) * x + std::sin(keys.turn) * axes.b;
    frame_.col(1) = std::cos(keys.turn) * axes.b - std::sin(keys.turn) * x;
    frame_.col(2) = axes.inward;
  }

  double flux() const override { return flux_; }
  Side side() const override { return face_; }
  double gap() const override { return gap_; }

  std::string note() const override {
    if (left_out_ < 1e-6) return {};
    return fmt::format("{:.3g} % of the flux of the ray file goes away from the backlight and is left out",
                       100.0 * left_out_);
  }

  Photon emit(core::PhotonRng& rng) const override {
    std::size_t place = 0;
    if (places_.size() > 1) {
      place =
          std::min(static_cast<std::size_t>(rng.uniform() * static_cast<double>(places_.size())), places_.size() - 1);
    }
    const FileRay ray = sampler_.sample(rng);
    const Vec3 from = ray.position - origin_;
    Photon photon;
    photon.position = places_[place] + frame_ * (from - from.z() / ray.direction.z() * ray.direction);
    // The crossing lies on the plane up to rounding; exactly there, whatever the way to it.
    photon.position[axis_of(face_)] = places_[place][axis_of(face_)];
    photon.light = light(ray);
    return photon;
  }

 private:
  core::StokesVector light(const FileRay& ray) const {
    const Vec3 k = (frame_ * ray.direction).normalized();
    if (ray.stokes.isZero(0.0)) return core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    const Vec3 axis = frame_ * ray.axis;
    const Vec3 s = ray.stokes / std::max(1.0, ray.stokes.norm());
    return {1.0, s.x(), s.y(), s.z(), {k, (axis - axis.dot(k) * k).normalized()}};
  }

  Side face_;
  double gap_;
  double flux_;
  std::vector<Vec3> places_;  // mm, on the plane
  Vec3 origin_;
  double left_out_;
  RaySampler sampler_;
  Eigen::Matrix3d frame_;
};

RayFileAxis read_axis(const core::ConfigNode& node) {
  const std::vector<std::string> names{"+x", "-x", "+y", "-y", "+z", "-z"};
  const std::string name = node.choice({"axis", "axis of the file that points into the backlight", names, "+z"});
  return static_cast<RayFileAxis>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The flux (lm) of one place out of the file.
std::optional<double> file_flux(const RayFileKeys& keys) {
  if (keys.layout.lumens) return keys.rays.forward;
  if (!keys.layout.head_flux) return std::nullopt;
  return *keys.layout.head_flux * keys.rays.forward / (keys.rays.forward + keys.rays.backward);
}

void read_file(const core::ConfigNode& node, RayFileKeys& keys) {
  const auto file = node.file({"file", "rays of a light source: IES TM-25 (.tm25ray) or Zemax binary (.dat, .sdf)"});
  const std::string format =
      node.choice({"format", "format of the file; auto: by its first bytes", {"auto", "tm25", "zemax"}, "auto"});
  keys.axis = read_axis(node);
  const auto flux = node.optional_number(
      {"flux_lm", "luminous flux of each place; default: that of the file's rays into the backlight",
       Range::positive(1e9)});
  if (file.empty()) return;
  const auto layout = node.guarded("file", [&] { return read_ray_file_head(file, format); });
  if (!layout) return;
  auto rays = node.guarded("file", [&] { return scan_rays(file, *layout, keys.axis); });
  if (!rays) return;
  keys.file = file;
  keys.layout = *layout;
  keys.rays = std::move(*rays);
  const auto of_file = flux ? flux : file_flux(keys);
  if (!of_file) node.fault_at("flux_lm", "must be given, as the file tells its flux in W only");
  keys.flux = of_file.value_or(1.0);
}

void read_places(const core::ConfigNode& node, RayFileKeys& keys) {
  keys.face = read_side(
      node, {"face", "face of the backlight that is lit", {"left", "right", "front", "back", "bottom", "top"}, "left"});
  keys.turn = node.number({"turn_deg", "turns the file about the normal, from its x axis towards its y axis",
                           Range::closed(-360, 360), 0.0});
  const auto origin = node.numbers({"origin_mm", "point of the file's frame that lies at the place",
                                    Range::closed(-1e4, 1e4), 3, 3, std::vector<double>{0, 0, 0}});
  if (origin.size() == 3) keys.origin = into_frame(keys.axis, {origin[0], origin[1], origin[2]});
  keys.count = static_cast<int>(node.integer({"count", "number of places along the face", 1, 10000, 1}));
  keys.pitch = node.optional_number(
      {"pitch_mm", "distance from place to place; default: the face shared evenly", Range::positive(10000)});
  keys.at = node.numbers({"at_mm", "the places along the face (y for left and right, else x), instead of count",
                          Range::closed(0, 10000), 0, 10000, std::vector<double>{}});
  if (!keys.at.empty() && (node.has("count") || node.has("pitch_mm"))) {
    node.fault_at("at_mm", "must be left out where count or pitch_mm is given, got both");
  }
  keys.across =
      node.optional_number({"across_mm", "the places across the face (z; y for bottom and top); default: its middle",
                            Range::closed(0, 10000)});
  keys.gap =
      node.number({"gap_mm", "air between the plane where rays start and the face", Range::closed(0, 100), 0.02});
}

/// The places on the plane before the face `box`; faults those beside it.
std::vector<Vec3> places_on(const core::ConfigNode& node, const RayFileKeys& keys, const Box& box) {
  constexpr double kSlack = 1e-9;
  const SideAxes axes = side_axes(keys.face);
  const double length = (box.max - box.min).dot(axes.a);
  const double width = (box.max - box.min).dot(axes.b);
  std::vector<double> at = keys.at;
  const double pitch = keys.pitch.value_or(length / keys.count);
  for (int i = 0; keys.at.empty() && i < keys.count; ++i) {
    at.push_back(0.5 * length + pitch * (i - 0.5 * (keys.count - 1)));
  }
  const auto [first, last] = std::minmax_element(at.begin(), at.end());
  if (*first < -kSlack || *last > length + kSlack) {
    node.fault_at(keys.at.empty() ? "pitch_mm" : "at_mm",
                  fmt::format("the places must lie on the {} face, 0 to {:.6g} mm along it, got {:.6g} to {:.6g} mm",
                              side_name(keys.face), length, *first, *last));
  }
  const double across = keys.across.value_or(0.5 * width);
  if (across > width + kSlack) {
    node.fault_at("across_mm", fmt::format("must lie on the {} face, 0 to {:.6g} mm across it, got {:.6g} mm",
                                           side_name(keys.face), width, across));
  }
  std::vector<Vec3> places;
  for (const double along : at) {
    Vec3 place = box.min + along * axes.a + across * axes.b;
    place[axis_of(keys.face)] = box.plane(keys.face) + (is_upper(keys.face) ? keys.gap : -keys.gap);
    places.push_back(place);
  }
  return places;
}

/// Stands in for a source whose file is at fault until all faults are told.
class NoSource final : public Source {
 public:
  explicit NoSource(Side face) : face_(face) {}
  double flux() const override { return 1.0; }
  Photon emit(core::PhotonRng&) const override { return {}; }
  Side side() const override { return face_; }
  double gap() const override { return 0.0; }

 private:
  Side face_;
};

}  // namespace

SourceSpec make_ray_file(const core::ConfigNode& node) {
  RayFileKeys keys;
  read_file(node, keys);
  read_places(node, keys);
  const Side face = keys.face;
  return {"ray_file", face, [node, keys = std::move(keys)](const SourcePlace& place) -> SourcePointer {
            std::vector<Vec3> places = places_on(node, keys, place.lit(keys.face));
            if (keys.file.empty()) return std::make_unique<NoSource>(keys.face);
            auto source = node.guarded(
                "file", [&]() -> SourcePointer { return std::make_unique<RayFileSource>(keys, std::move(places)); });
            return source ? std::move(*source) : std::make_unique<NoSource>(keys.face);
          }};
}

}  // namespace evenglow::tracer

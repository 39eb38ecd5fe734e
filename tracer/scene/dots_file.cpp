#include "tracer/scene/dots_file.h"

#include <cmath>
#include <filesystem>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/config/message_text.h"
#include "core/dots/dot_csv.h"
#include "core/dots/dot_dxf.h"

namespace evenglow::tracer {
namespace {

using core::ConfigNode;

core::DotPattern read_pattern(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".dxf" ? core::read_dot_dxf(file).dots : core::read_dot_csv(file);
}

[[noreturn]] void refuse(const std::string& name, std::string message) {
  throw core::ConfigError(core::Fault{core::one_line(name), 0, 0, "", std::move(message)});
}

/// Solid bumps cannot stand in each other.
void check_apart(const DotGrid& grid, const core::DotPattern& dots, const std::string& name) {
  const auto [a, b] = grid.overlapping();
  if (a < 0) return;
  const core::Dot& one = dots[static_cast<std::size_t>(a)];
  const core::Dot& other = dots[static_cast<std::size_t>(b)];
  refuse(name, fmt::format("shapes with a height must not overlap, got dots {} and {} at ({:.6g}, {:.6g}) and "
                           "({:.6g}, {:.6g}) mm",
                           a + 1, b + 1, one.x, one.y, other.x, other.y));
}

/// Density, `fill` and `axis_deg` may stand there, as in the run file that the dots were designed with.
void check_keys(const ConfigNode& node, const std::string& shape) {
  if (node.has("density_file")) node.fault_at("density_file", "must be left out where there is a dots_file, got both");
  if (shape == "v_groove") {
    node.fault_at("dots_file",
                  "is for shapes that stand as dots (printed_dot, microlens, cone, pyramid), got it with "
                  "kind: v_groove, which has no ends");
  }
}

}  // namespace

core::Footprint usual_footprint(const std::string& shape) {
  return shape == "pyramid" || shape == "v_groove" ? core::Footprint::square : core::Footprint::round;
}

void check_within(const core::DotPattern& dots, core::Footprint footprint, const FaceArea& face,
                  const std::string& name) {
  constexpr double kSlack = 1e-4;  // mm: of places that were rounded when they were written
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const core::Dot& dot = dots[i];
    const double turned =
        footprint == core::Footprint::square ? std::abs(std::cos(dot.angle)) + std::abs(std::sin(dot.angle)) : 1.0;
    const double half = static_cast<double>(dot.radius) * turned - kSlack;
    if (dot.x - half >= face.x0 && dot.x + half <= face.x1 && dot.y - half >= face.y0 && dot.y + half <= face.y1)
      continue;
    refuse(name, fmt::format("dots must lie on the face, x {:g} to {:g} and y {:g} to {:g} mm, got dot {} of {:.6g} um "
                             "at ({:.6g}, {:.6g}) mm",
                             face.x0, face.x1, face.y0, face.y1, i + 1,
                             2.0 * static_cast<double>(dot.radius) / core::kMmPerUm, dot.x, dot.y));
  }
}

std::shared_ptr<const DotGrid> read_dots_file(const ConfigNode& node, const std::string& shape, const FaceArea& face) {
  const auto path = node.file(
      {"dots_file",
       "the pattern dot by dot (CSV or DXF, as `evenglow dots` writes them) in place of a "
       "density; each dot is traced where it lies and as it is turned (density, fill and axis_deg do not count)",
       std::string()});
  const std::string usual = usual_footprint(shape) == core::Footprint::square ? "square" : "round";
  const std::string outline = node.choice(
      {"footprint", "outline of each dot of the dots_file; default: that of the shape", {"round", "square"}, usual});
  if (path.empty()) {
    if (node.has("footprint")) node.fault_at("footprint", "is for dots of a dots_file, got none of it");
    return nullptr;
  }
  check_keys(node, shape);
  if (shape != "printed_dot" && outline != usual) {
    node.fault_at("footprint", fmt::format("must be {} for kind: {}, got {}", usual, shape, outline));
    return nullptr;
  }
  const auto footprint = outline == "square" ? core::Footprint::square : core::Footprint::round;
  const auto grid = node.guarded("dots_file", [&] {
    const core::DotPattern dots = read_pattern(path);
    check_within(dots, footprint, face, path.string());
    auto made = std::make_shared<const DotGrid>(dots, footprint, face);
    if (shape != "printed_dot") check_apart(*made, dots, path.string());
    return made;
  });
  return grid ? *grid : nullptr;
}

}  // namespace evenglow::tracer

#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/base/error.h"
#include "design/dots/dot_files.h"
#include "design/dots/gds_records.h"
#include "design/dots/square_corners.h"
#include "design/dots/streamed_file.h"

namespace evenglow::design {
namespace {

using Type = GdsRecords::Type;
using Ints16 = std::vector<std::int16_t>;
using Ints32 = std::vector<std::int32_t>;

constexpr std::size_t kFlush = 1 << 16;
constexpr int kCorners = 64;
constexpr double kPerMm = 1e6;  // database units
/// The time stamps: the same file for the same dots.
const Ints16 kStamp = {2000, 1, 1, 0, 0, 0, 2000, 1, 1, 0, 0, 0};

std::int32_t whole(double mm) {
  const double value = std::round(mm * kPerMm);
  if (!(std::abs(value) < 2147483647.0))
    throw core::Error(fmt::format("a GDSII file in nm holds places within +-2147 mm, got {:g} mm", mm));
  return static_cast<std::int32_t>(value);
}

/// Dots of one size and, if square, one direction share a structure.
using SizeClass = std::pair<float, float>;

SizeClass class_of(const core::Dot& dot, core::Footprint footprint) {
  return {dot.radius, footprint == core::Footprint::square ? dot.angle : 0.0f};
}

Ints32 outline(const SizeClass& size, core::Footprint footprint) {
  Ints32 points;
  const auto add = [&](double x, double y) {
    points.push_back(whole(x));
    points.push_back(whole(y));
  };
  const double radius = static_cast<double>(size.first);
  if (footprint == core::Footprint::square) {
    for (const auto& [x, y] : square_corners(radius, static_cast<double>(size.second))) add(x, y);
  } else {
    const double turn = 2.0 * std::numbers::pi / kCorners;
    const double corner = radius * std::sqrt(turn / std::sin(turn));  // the polygon has the circle's area
    for (int i = 0; i < kCorners; ++i) add(corner * std::cos(turn * (i + 0.5)), corner * std::sin(turn * (i + 0.5)));
  }
  points.push_back(points[0]);
  points.push_back(points[1]);
  return points;
}

}  // namespace

void write_dot_gds(const DotSheet& sheet, const std::filesystem::path& path) {
  StreamedFile file(path);
  GdsRecords records;
  records.add(Type::header, Ints16{600});
  records.add(Type::begin_library, kStamp);
  records.add(Type::library_name, "EVENGLOW");
  records.add(Type::units, std::vector<double>{1e-3, 1e-9});  // user units and meters in a database unit
  std::map<SizeClass, std::string> names;
  for (const core::Dot& dot : sheet.dots) names.emplace(class_of(dot, sheet.footprint), "");
  int number = 0;
  for (auto& [size, name] : names) {
    name = fmt::format("D{}_{}", std::lround(2.0 * static_cast<double>(size.first) * kPerMm), ++number);
    records.add(Type::begin_structure, kStamp);
    records.add(Type::structure_name, name);
    records.add(Type::boundary);
    records.add(Type::layer, Ints16{1});
    records.add(Type::data_type, Ints16{0});
    records.add(Type::points, outline(size, sheet.footprint));
    records.add(Type::end_element);
    records.add(Type::end_structure);
  }
  records.add(Type::begin_structure, kStamp);
  records.add(Type::structure_name, "DOTS");
  for (const core::Dot& dot : sheet.dots) {
    records.add(Type::reference);
    records.add(Type::referred_name, names.at(class_of(dot, sheet.footprint)));
    records.add(Type::points, Ints32{whole(dot.x), whole(dot.y)});
    records.add(Type::end_element);
    if (records.bytes().size() < kFlush) continue;
    file.write(records.bytes());
    records.clear();
  }
  records.add(Type::end_structure);
  records.add(Type::end_library);
  file.write(records.bytes());
  file.finish();
}

}  // namespace evenglow::design

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/config/config_node.h"
#include "core/config/config_state.h"
#include "core/config/located_override.h"
#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

using Override = ConfigDocument::Override;
using Point = std::vector<Override>;

constexpr std::size_t kMaxPoints = 10000;
constexpr std::size_t kMaxNameLength = 80;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

/// `haze-0.9` of `backlight.films[0].haze` = 0.9; nothing of a value that is no short plain word.
std::string told(const Override& change) {
  const ConfigValue& value = *change.located->value;
  constexpr std::size_t kLongestWord = 24;
  const bool plain = value.is_scalar() && !value.text.empty() && value.text.size() <= kLongestWord &&
                     std::all_of(value.text.begin(), value.text.end(), is_plain);
  std::string key = change.path.substr(change.path.rfind('.') + 1);
  std::erase_if(key, [](char c) { return !is_plain(c); });
  return plain ? "_" + key + "-" + value.text : "_" + key;
}

std::string name_of(std::size_t index, std::size_t count, const Point& point) {
  std::string name = fmt::format("p{:0{}}", index + 1, std::to_string(count).size());
  for (const Override& change : point) {
    const std::string more = told(change);
    if (name.size() + more.size() > kMaxNameLength) break;
    name += more;
  }
  return name;
}

/// A key path of `grid` or `zip` with its values.
using Axis = std::vector<Override>;

std::vector<Axis> read_axes(const ConfigNode& node, const ConfigValue& map) {
  std::vector<Axis> axes;
  for (const auto& [path, values_node] : node.entries()) {
    const ConfigValue& values = *map.find(path)->value;
    const bool good = values.is_list() && !values.children.empty();
    if (!good) values_node.fault("must be a list of at least one value, got " + described(values));
    values_node.mark_read();
    if (!good) continue;
    axes.emplace_back();
    for (const ConfigChild& item : values.children)
      axes.back().push_back(located_override(path, *item.value, item.place));
  }
  return axes;
}

std::vector<Point> grid_of(const ConfigNode& node, const std::vector<Axis>& axes) {
  std::size_t count = axes.empty() ? 0 : 1;
  for (const Axis& axis : axes) {
    if (count > kMaxPoints / axis.size()) {
      node.fault(fmt::format("must not make more than {} points, got more", kMaxPoints));
      return {};
    }
    count *= axis.size();
  }
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t below = count;
    for (const Axis& axis : axes) {
      below /= axis.size();
      points[i].push_back(axis[i / below % axis.size()]);
    }
  }
  return points;
}

std::vector<Point> zip_of(const ConfigNode& node, const std::vector<Axis>& axes) {
  if (axes.empty()) return {};
  const std::size_t count = axes.front().size();
  for (const Axis& axis : axes) {
    if (axis.size() == count && count <= kMaxPoints) continue;
    node.fault(fmt::format("must give each key as many values as the first ({}), at most {}, got {} for {}", count,
                           kMaxPoints, axis.size(), shown(axis.front().path)));
    return {};
  }
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const Axis& axis : axes) points[i].push_back(axis[i]);
  }
  return points;
}

std::vector<Point> list_of(const std::vector<ConfigNode>& items, const ConfigValue& list) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < items.size(); ++i) {
    items[i].mark_read();
    points.emplace_back();
    if (!list.children[i].value->is_map()) continue;
    for (const ConfigChild& change : list.children[i].value->children)
      points.back().push_back(located_override(change.key, *change.value, change.place));
  }
  return points;
}

}  // namespace

std::vector<ConfigDocument::Variant> ConfigDocument::sweep() const {
  const ConfigNode node = root().map("sweep", "points that a batch runs: one of grid, zip and list");
  const ConfigNode grid = node.map("grid", "key paths, each with a list of values: all combinations");
  const ConfigNode zip = node.map("zip", "key paths, each with a list of as many values: the first of each, ...");
  const auto items = node.maps("list", "each point of the sweep: a map of key paths, as a variant", kMaxPoints);
  if (!node.present() || !node.is_map()) return {};
  const ConfigValue& map = *state_->root->find("sweep")->value;
  const int ways = (node.has("grid") ? 1 : 0) + (node.has("zip") ? 1 : 0) + (node.has("list") ? 1 : 0);
  if (ways != 1) {
    node.fault(fmt::format("must hold one of grid, zip and list, got {}", ways == 0 ? "none" : "several"));
    node.mark_read();
    return {};
  }
  std::vector<Point> points;
  if (grid.present() && grid.is_map()) points = grid_of(grid, read_axes(grid, *map.find("grid")->value));
  if (zip.present() && zip.is_map()) points = zip_of(zip, read_axes(zip, *map.find("zip")->value));
  if (!items.empty()) points = list_of(items, *map.find("list")->value);
  std::vector<Variant> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string name = name_of(i, points.size(), points[i]);
    result.emplace_back(std::move(name), std::move(points[i]));
  }
  return result;
}

}  // namespace evenglow::core

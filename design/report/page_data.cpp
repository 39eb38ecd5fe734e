#include "design/report/page_data.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "design/report/color_map.h"
#include "design/report/text_escape.h"
#include "design/report/value_scale.h"

namespace evenglow::design {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "null";
}

template <typename Values, typename Get>
std::string list(const Values& values, Get&& get) {
  std::string text = "[";
  for (const auto& value : values) {
    if (text.size() > 1) text += ',';
    text += number(get(value));
  }
  return text + ']';
}

std::string list(const std::vector<double>& values) {
  return list(values, [](double value) { return value; });
}

std::string json_string(std::string_view text) {
  return nlohmann::json(std::string(text)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string PageData::add(std::string object) {
  std::string name = fmt::format("d{}", count_++);
  objects_ += fmt::format(",\n\"{}\":{}", name, object);
  return name;
}

std::string PageData::add_map(const core::CellField& field, const core::CellField* se, const MapFacts& facts) {
  const core::CellGrid& g = field.grid;
  const bool with_se = se != nullptr && se->grid == g && is_filled(*se);
  return add(fmt::format(R"({{"nx":{},"ny":{},"x0":{},"y0":{},"dx":{},"dy":{},"name":{},"quantity":{},"unit":{},)"
                         R"("colors":{},"series":{},"scale":[{},{}],"v":{},"s":{}}})",
                         g.nx, g.ny, g.x0, g.y0, g.dx, g.dy, json_string(facts.name), json_string(facts.quantity),
                         json_string(facts.unit), json_string(facts.colors), facts.series, facts.scale.low,
                         facts.scale.high, list(field.values), with_se ? list(se->values) : "[]"));
}

std::string PageData::add_polar(const AngularLuminance& angular, std::string_view unit, double top) {
  return add(fmt::format(R"({{"polar":{},"azimuths":{},"unit":{},"colors":"luminance","top":{},"v":{},"s":{}}})",
                         list(angular.polar_deg), angular.azimuth_count, json_string(unit), top,
                         list(angular.luminance, [](const core::Estimate& e) { return e.value; }),
                         list(angular.luminance, [](const core::Estimate& e) { return e.se; })));
}

std::string PageData::add_curves(const CurvePlot& plot, const PlotFrame& frame, double picture_width) {
  std::string curves;
  for (const Curve& curve : plot.curves) {
    if (!curves.empty()) curves += ',';
    curves += fmt::format(R"({{"n":{},"x":{},"y":{},"s":{}}})", json_string(curve.name), list(curve.x), list(curve.y),
                          list(curve.se));
  }
  return add(fmt::format(R"({{"x":{},"area":[{:.4f},{:.4f}],"range":[{},{}],"curves":[{}]}})",
                         json_string(plot.x_label), frame.area.left / picture_width, frame.area.right() / picture_width,
                         frame.x.range.low, frame.x.range.high, curves));
}

std::string PageData::json() const {
  return script_safe(
      fmt::format(R"({{"colors":{{"luminance":"{}","density":"{}","difference":"{}","rainbow":"{}"}}{}}})",
                  ColorMap::luminance().hex(), ColorMap::density().hex(), ColorMap::difference().hex(),
                  ColorMap::rainbow().hex(), objects_));
}

}  // namespace evenglow::design

#include "design/report/json_metrology.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;

void put(Json& object, const std::string& key, const core::Estimate& estimate) {
  object[key] = estimate.value;
  object[key + "_se"] = estimate.se;
}

Json emitted_json(const ColorPoint& point) {
  return {{"x", point.x.value}, {"y", point.y.value},          {"u", point.u.value},
          {"v", point.v.value}, {"cct_k", point.kelvin.value}, {"duv", point.distance.value}};
}

Json point_json(const ColorPoint& point) {
  Json object = Json::object();
  put(object, "x", point.x);
  put(object, "y", point.y);
  put(object, "u", point.u);
  put(object, "v", point.v);
  put(object, "cct_k", point.kelvin);
  put(object, "duv", point.distance);
  return object;
}

Json half_angles_json(const std::optional<HalfAngles>& angles) {
  if (!angles) return nullptr;
  Json object = Json::object();
  put(object, "from_deg", angles->from_deg);
  put(object, "to_deg", angles->to_deg);
  put(object, "width_deg", angles->width_deg);
  return object;
}

Json figures_json(const FinalJudgment& f) {
  return {{"photons", f.photons},
          {"rms", f.rms},
          {"rms_corrected", f.rms_corrected.value},
          {"rms_corrected_se", f.rms_corrected.se},
          {"uniformity_9", f.uniformity_9},
          {"uniformity_13", f.uniformity_13},
          {"luminance_mean_cd_m2", f.luminance_mean.value},
          {"luminance_mean_se", f.luminance_mean.se},
          {"luminance_centre_cd_m2", f.luminance_center},
          {"efficiency", f.efficiency.value},
          {"efficiency_se", f.efficiency.se},
          {"rms_95_low", f.rms_low},
          {"rms_95_high", f.rms_high},
          {"uniformity_9_se", f.uniformity_9_se},
          {"uniformity_13_se", f.uniformity_13_se},
          {"luminance_centre_se", f.luminance_center_se}};
}

}  // namespace

nlohmann::ordered_json final_json(const FinalJudgment& f) {
  Json object = figures_json(f);
  for (const ViewJudgment& view : f.views) {
    Json entry{{"direction_deg", {view.polar_deg, view.azimuth_deg}}, {"weight", view.share}};
    put(entry, "rms_corrected", view.rms_corrected);
    put(entry, "luminance_mean_cd_m2", view.luminance_mean);
    object["views"].push_back(std::move(entry));
  }
  return object;
}

Json color_json(const ColorJudgment& color) {
  Json object{{"mean", point_json(color.mean)}, {"emitted", emitted_json(color.emitted)}};
  put(object, "shift_uv", color.shift);
  object["delta_uv_rms"] = color.rms;
  put(object, "delta_uv_rms_corrected", color.rms_corrected);
  put(object, "delta_uv_max", color.max);
  object["delta_uv_max_at_mm"] = {color.max_x, color.max_y};
  put(object, "delta_uv_max_corrected", color.max_corrected);
  object["dark_cells"] = color.dark_cells;
  return object;
}

Json half_maximum_json(const AngularLuminance& angular, const std::vector<SpotLuminance>& spots) {
  Json object{{"horizontal", half_angles_json(angular.horizontal)}, {"vertical", half_angles_json(angular.vertical)}};
  if (spots.empty()) return object;
  object["spots"] = Json::array();
  for (const SpotLuminance& spot : spots) {
    object["spots"].push_back({{"x_mm", spot.x},
                               {"y_mm", spot.y},
                               {"diameter_mm", spot.diameter},
                               {"horizontal", half_angles_json(spot.angular.horizontal)},
                               {"vertical", half_angles_json(spot.angular.vertical)}});
  }
  return object;
}

Json hot_spot_json(const std::vector<HotSpots>& rows) {
  Json list = Json::array();
  for (const HotSpots& row : rows) {
    Json object{{"source", row.source},
                {"edge", row.edge},
                {"gaps", row.gaps},
                {"led_mm", row.led_width},
                {"gap_mm", row.gap_width}};
    if (!row.lines.empty()) {
      object["distance_mm"] = row.lines.front().distance;
      put(object, "ratio", row.lines.front().ratio);
    }
    object["mixing_distance_mm"] = row.mixing_distance ? Json(*row.mixing_distance) : Json(nullptr);
    list.push_back(std::move(object));
  }
  return list;
}

void add_metrology(const Report& report, Json& object) {
  if (report.color) object["color"] = color_json(*report.color);
  if (report.angular) object["half_maximum"] = half_maximum_json(*report.angular, report.angular_spots);
  if (!report.hot_spots.empty()) object["hot_spot"] = hot_spot_json(report.hot_spots);
}

}  // namespace evenglow::design

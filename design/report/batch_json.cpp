#include <algorithm>
#include <array>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/config/json_depth.h"
#include "design/report/batch_table.h"
#include "design/report/json_metrology.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "evenglow-batch/1";
constexpr std::array<std::string_view, 4> kStatusNames = {"waiting", "done", "failed", "wrong_input"};

FinalJudgment final_from(const Json& node) {
  const auto number = [&](const char* key) {
    return node.at(key).is_null() ? std::numeric_limits<double>::quiet_NaN() : node.at(key).get<double>();
  };
  const auto estimate = [&](const char* value, const char* se) { return core::Estimate{number(value), number(se)}; };
  FinalJudgment f;
  f.photons = node.at("photons").get<std::uint64_t>();
  f.rms = number("rms");
  f.rms_corrected = estimate("rms_corrected", "rms_corrected_se");
  f.uniformity_9 = number("uniformity_9");
  f.uniformity_13 = number("uniformity_13");
  f.luminance_mean = estimate("luminance_mean_cd_m2", "luminance_mean_se");
  f.luminance_center = number("luminance_centre_cd_m2");
  f.efficiency = estimate("efficiency", "efficiency_se");
  f.rms_low = number("rms_95_low");
  f.rms_high = number("rms_95_high");
  f.uniformity_9_se = number("uniformity_9_se");
  f.uniformity_13_se = number("uniformity_13_se");
  f.luminance_center_se = number("luminance_centre_se");
  return f;
}

Json row_of(const BatchRow& row) {
  Json changes = Json::object();
  for (const auto& [key, value] : row.changes) changes[key] = value;
  Json json = {{"name", row.name},       {"file", row.file},   {"status", status_name(row.status)},
               {"message", row.message}, {"changes", changes}, {"identity", row.identity},
               {"cpu_s", row.cpu_s}};
  if (row.status == BatchStatus::kDone) json["final"] = final_json(row.final);
  return json;
}

BatchRow row_from(const Json& node) {
  BatchRow row;
  row.name = node.at("name").get<std::string>();
  row.file = node.at("file").get<std::string>();
  const auto status = node.at("status").get<std::string>();
  const auto known = std::find(kStatusNames.begin(), kStatusNames.end(), status);
  core::expects(known != kStatusNames.end(), "a status that is known");
  row.status = static_cast<BatchStatus>(known - kStatusNames.begin());
  row.message = node.at("message").get<std::string>();
  for (const auto& [key, value] : node.at("changes").items()) row.changes.emplace_back(key, value.get<std::string>());
  row.identity = node.at("identity").get<std::string>();
  row.cpu_s = node.at("cpu_s").get<double>();
  if (row.status == BatchStatus::kDone) row.final = final_from(node.at("final"));
  return row;
}

}  // namespace

std::string_view status_name(BatchStatus status) {
  return kStatusNames[static_cast<std::size_t>(status)];
}

std::string batch_json(const BatchTable& table) {
  Json rows = Json::array();
  for (const BatchRow& row : table.rows) rows.push_back(row_of(row));
  const Json json = {{"format", kFormat},        {"version", table.version},     {"title", table.title},
                     {"command", table.command}, {"left_over", table.left_over}, {"runs", rows}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

BatchTable read_batch_json(const std::string& text) {
  try {
    core::require_shallow_json(text);
    const Json json = Json::parse(text);
    core::expects(json.at("format").get<std::string>() == kFormat, "the format evenglow-batch/1");
    BatchTable table;
    table.version = json.at("version").get<std::string>();
    table.title = json.at("title").get<std::string>();
    table.command = json.at("command").get<std::string>();
    if (json.contains("left_over")) table.left_over = json.at("left_over").get<std::vector<std::string>>();
    for (const Json& row : json.at("runs")) table.rows.push_back(row_from(row));
    return table;
  } catch (const std::exception&) {
    throw core::Error("is no summary of a batch (format evenglow-batch/1)");
  }
}

}  // namespace evenglow::design

#include "app/key_schema.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/version.h"

namespace evenglow::app {
namespace {

using core::DeclaredKey;
using Json = nlohmann::ordered_json;

/// A number reads back from YAML, or stays text.
Json value_of(const std::string& yaml) {
  char* end = nullptr;
  const double number = std::strtod(yaml.c_str(), &end);
  const bool is_number = !yaml.empty() && end == yaml.c_str() + yaml.size() && std::isfinite(number);
  if (!is_number) return yaml;
  return std::floor(number) == number && std::abs(number) < 9e15 ? Json(static_cast<std::int64_t>(number))
                                                                 : Json(number);
}

void add_range(const DeclaredKey& key, Json& schema) {
  if (!key.range) return;
  const core::Range& r = *key.range;
  if (std::isfinite(r.min)) schema[r.min_open ? "exclusiveMinimum" : "minimum"] = r.min;
  if (std::isfinite(r.max)) schema[r.max_open ? "exclusiveMaximum" : "maximum"] = r.max;
}

/// A word of a choice may look like a number: `at: 9`.
Json words(const std::vector<std::string>& options) {
  Json list = Json::array();
  for (const std::string& option : options) {
    list.push_back(option);
    const Json value = value_of(option);
    if (!value.is_string()) list.push_back(value);
  }
  return list;
}

class SchemaWriter {
 public:
  explicit SchemaWriter(const std::vector<DeclaredKey>& keys) {
    for (const DeclaredKey& key : keys) nodes_[key.node].push_back(&key);
  }

  Json document() {
    Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                   {"$id", "evenglow-run-file/1"},
                   {"title", "Run file of Evenglow " + std::string(core::version())}};
    schema.update(map_schema(""));
    return schema;
  }

 private:
  Json key_schema(const DeclaredKey& key) {
    Json schema = typed(key);
    std::string help = key.help;
    if (!key.unit.empty()) help += " (" + key.unit + ")";
    if (!help.empty()) schema["description"] = help;
    if (!key.fallback.empty() && key.max_count == 0) schema["default"] = value_of(key.fallback);
    return schema;
  }

  Json typed(const DeclaredKey& key) {
    const std::string path = key.node.empty() ? key.key : key.node + "." + key.key;
    if (key.type == "map") return map_schema(path);
    if (key.type == "maps") return {{"type", "array"}, {"items", map_schema(path + "[]")}, {"maxItems", key.max_count}};
    if (key.type == "boolean") return {{"type", "boolean"}};
    if (key.type == "choice") return {{"enum", words(key.options)}};
    if (key.type == "choices") {
      Json list = {{"type", "array"}, {"items", {{"enum", words(key.options)}}}, {"uniqueItems", true}};
      if (path == "output") list["minItems"] = 1;
      return list;
    }
    if (key.type == "file") return {{"type", "string"}};
    if (key.type == "text") return {{"type", {"string", "number", "boolean"}}};
    Json number = {{"type", key.type == "integer" || key.type == "count" || key.whole ? "integer" : "number"}};
    add_range(key, number);
    if (key.type != "numbers") return number;
    return {{"type", "array"}, {"items", number}, {"minItems", key.min_count}, {"maxItems", key.max_count}};
  }

  static bool is_free(const std::string& path) {
    return path == "variants" || path == "sweep.grid" || path == "sweep.zip" || path == "sweep.list[]";
  }

  Json free_schema(const std::string& path) {
    Json any = Json::object();
    if (path == "variants") any = {{"type", "object"}};
    if (path == "sweep.grid" || path == "sweep.zip") any = {{"type", "array"}, {"minItems", 1}};
    Json schema = {{"type", "object"}, {"additionalProperties", any}};
    if (path == "variants") schema["propertyNames"] = {{"pattern", "^[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}$"}};
    return schema;
  }

  /// The schema of the map at `path`: the keys of every kind, each kind with its own.
  Json map_schema(const std::string& path) {
    if (is_free(path)) return free_schema(path);
    std::vector<std::string> kinds;
    for (const DeclaredKey* key : nodes_[path]) {
      if (key->key == "kind" && key->type == "choice") kinds = key->options;
    }
    if (kinds.empty()) return closed(path, "");
    Json schema = {{"type", "object"}};
    const DeclaredKey* kind = *std::find_if(nodes_[path].begin(), nodes_[path].end(),
                                            [](const DeclaredKey* key) { return key->key == "kind"; });
    schema["properties"] = {{"kind", {{"enum", kinds}, {"description", kind->help}}}};
    if (kind->required) schema["anyOf"] = {{{"required", {"kind"}}}, {{"required", {"include"}}}};
    Json choices = Json::array();
    for (const std::string& name : kinds) {
      const Json is_this = {{"properties", {{"kind", {{"const", name}}}}}, {"required", {"kind"}}};
      choices.push_back({{"if", is_this}, {"then", closed(path, name)}});
    }
    if (!kind->fallback.empty()) {
      const Json is_default = {{"not", {{"anyOf", {{{"required", {"kind"}}}, {{"required", {"include"}}}}}}}};
      choices.push_back({{"if", is_default}, {"then", closed(path, kind->fallback)}});
    }
    schema["allOf"] = choices;
    return schema;
  }

  Json closed(const std::string& path, const std::string& kind) {
    Json properties = Json::object();
    std::set<std::string> required;
    std::map<std::string, int> types;
    for (const DeclaredKey* key : nodes_[path]) {
      if (!key->kind.empty() && key->kind != kind) continue;
      Json schema = key->key == "kind" && !kind.empty() ? Json{{"const", kind}} : key_schema(*key);
      if (types[key->key]++ > 0) schema = one_of_two(properties[key->key], schema);
      properties[key->key] = schema;
      if (key->required) required.insert(key->key);
    }
    properties["include"] = {{"type", "string"}, {"description", "file that holds more keys of this map"}};
    Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) schema["anyOf"] = {{{"required", required}}, {{"required", {"include"}}}};
    return schema;
  }

  static Json one_of_two(const Json& first, const Json& second) {
    if (first == second) return first;
    if (first.contains("anyOf") && !first.contains("type")) {
      Json more = first;
      more["anyOf"].push_back(second);
      return more;
    }
    return {{"anyOf", {first, second}}};
  }

  std::map<std::string, std::vector<const DeclaredKey*>> nodes_;
};

}  // namespace

std::string key_schema(const std::vector<DeclaredKey>& keys) {
  return SchemaWriter(keys).document().dump(2) + '\n';
}

}  // namespace evenglow::app

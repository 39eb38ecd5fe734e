#include "app/dots_input.h"

#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/run_file.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/units.h"
#include "core/config/json_depth.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"
#include "tracer/films/bef.h"
#include "tracer/scene/density_file.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxResult = std::size_t{16} << 20;

[[noreturn]] void refuse(const fs::path& path, const std::string& message) {
  throw core::ConfigError(core::Fault{core::one_line(path.string()), 0, 0, "", message});
}

/// What `result.json` tells of the run.
struct Origin {
  std::string title, variant, command, sha256;
  DotsOverrides overrides;
};

Origin read_origin(const fs::path& directory) {
  std::error_code ignored;
  const fs::path file = directory / "result.json";
  if (!fs::exists(file, ignored) && fs::exists(directory / "compare.json", ignored))
    refuse(directory, "must be the directory of one design, got a comparison (name the folder of a variant in it)");
  const std::string content = core::read_text_file(file, kMaxResult);
  try {
    core::require_shallow_json(content);
  } catch (const core::Error& error) {
    refuse(file, std::string("must be the result of a design, but ") + error.what());
  }
  const Json result = Json::parse(content, nullptr, false);
  const auto text = [&](const char* key) {
    const auto found = result.is_object() ? result.find(key) : result.end();
    if (found == result.end() || !found->is_string())
      refuse(file, fmt::format("must be the result of a design, got no text under \"{}\"", key));
    return found->get<std::string>();
  };
  if (!text("format").starts_with("evenglow-result/"))
    refuse(file, "must be of the format evenglow-result, got " + core::shown(text("format")));
  Origin origin{text("title"), text("variant"), text("command"), text("run_file_sha256"), {}};
  const auto list = result.find("overrides");
  if (list == result.end() || !list->is_array()) refuse(file, "must list the overrides of the run, got none");
  for (const Json& change : *list) {
    const std::string pair = change.is_string() ? change.get<std::string>() : "";
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos)
      refuse(file, "overrides must be texts key=value, got " + core::shown(change.dump()));
    origin.overrides.push_back({pair.substr(0, equals), pair.substr(equals + 1), "result.json"});
  }
  return origin;
}

/// The words of a command line as this program writes it: plain, or in single quotes.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  bool quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\'') {
      quoted = !quoted;
    } else if (command[i] == '\\' && !quoted && i + 1 < command.size()) {
      words.back() += command[++i];
    } else if (command[i] == ' ' && !quoted) {
      words.emplace_back();
    } else {
      words.back() += command[i];
    }
  }
  return words;
}

fs::path find_run_file(const fs::path& directory, const Origin& origin) {
  std::error_code ignored;
  for (const std::string& word : words_of(origin.command)) {
    for (const fs::path& path : {fs::path(word), directory / fs::path(word).filename()}) {
      if (word.empty() || !fs::is_regular_file(path, ignored) || fs::file_size(path, ignored) > core::kMaxRunFileBytes)
        continue;
      if (core::sha256_hex(core::read_text_file(path)) == origin.sha256) return path;
    }
  }
  refuse(directory,
         fmt::format("the run file of this design must be given by --run: no file that \"{}\" names is here with "
                     "the checksum that result.json holds",
                     core::shown(origin.command, 200)));
}

void take_films(const Run& run, DotsInput& input) {
  for (std::size_t i = 0; i < run.backlight.films.size(); ++i) {
    const tracer::Film& film = run.backlight.films[i];
    const auto* prisms = dynamic_cast<const tracer::PrismFilm*>(film.surface.get());
    if (prisms == nullptr) continue;
    const auto& spec = prisms->spec();
    input.gratings.push_back(
        {fmt::format("films[{}] ({})", i, film.kind), {spec.profile.pitch, 0.0, spec.axis + 0.5 * core::kPi}, false});
  }
}

void take_panel(DotsInput& input) {
  if (input.spec.panel) input.gratings.push_back({"panel", *input.spec.panel, true});
}

Run read_with(const fs::path& file, DotsOverrides changes, const DotsOverrides& more) {
  changes.insert(changes.end(), more.begin(), more.end());
  return read_point(file, {"", std::move(changes)}, {});
}

}  // namespace

DotsInput dots_input_of(const Run& run, const std::string& file) {
  DotsInput input;
  input.title = run.title;
  input.spec = run.dots;
  input.run_file = file;
  const tracer::Box& area = run.backlight.area;
  input.plate = {area.min.x(), area.max.x(), area.min.y(), area.max.y()};
  take_films(run, input);
  take_panel(input);
  return input;
}

DotsInput read_designed(const fs::path& directory, const fs::path& run_file, const DotsOverrides& overrides) {
  const Origin origin = read_origin(directory);
  const fs::path file = run_file.empty() ? find_run_file(directory, origin) : run_file;
  const Run run = read_with(file, origin.overrides, overrides);
  if (!run.backlight.plate || !run.backlight.microstructure)
    refuse(file, "must describe a light_guide_plate with a microstructure, got none");
  DotsInput input = dots_input_of(run, file.string());
  if (!origin.variant.empty()) input.title += " (" + origin.variant + ")";
  if (!run_file.empty() && core::sha256_hex(run.file_text) != origin.sha256)
    input.remarks.push_back(core::one_line(file.string()) + " is not, or no longer, the run file of this design");
  const fs::path density_file = directory / "density.csv";
  const core::NumberMatrix density = tracer::read_density_file(density_file);
  input.coverage = core::CellField(
      core::CellGrid::over(density.nx, density.ny, input.plate.x0, input.plate.y0, input.plate.x1, input.plate.y1),
      0.0);
  for (std::size_t i = 0; i < density.values.size(); ++i)
    input.coverage->values[i] = density.values[i] * run.backlight.microstructure->shape.fill;
  return input;
}

DotsInput read_surroundings(const fs::path& run_file, const DotsOverrides& overrides) {
  if (!run_file.empty()) return dots_input_of(read_with(run_file, {}, overrides), run_file.string());
  auto document = core::ConfigDocument::parse("dots: {}\n", "options");
  for (const auto& change : overrides) document.apply(change);
  DotsInput input;
  input.spec =
      design::read_dots(document.root().map("dots", "how the density becomes real dots"), core::Footprint::round);
  document.finish();
  take_panel(input);
  return input;
}

}  // namespace evenglow::app

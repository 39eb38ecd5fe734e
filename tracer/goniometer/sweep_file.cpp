#include "tracer/goniometer/sweep_file.h"

#include <utility>

#include <fmt/format.h>

#include "tracer/films/film_registry.h"

namespace evenglow::tracer {
namespace {

using core::ConfigDocument;
using core::ConfigNode;

[[noreturn]] void refuse_index(const std::string& message) {
  throw core::ConfigError(core::Fault{"--film", 0, 0, "", message});
}

/// What another command reads is not judged here.
void leave_aside(const ConfigNode& map, std::string_view but) {
  for (const auto& [name, node] : map.entries()) {
    if (name != but) node.mark_read();
  }
}

std::optional<Film> film_of_run_file(const ConfigDocument& document, std::optional<int> index) {
  const auto root = document.root();
  const auto backlight = root.map("backlight", "the backlight");
  const auto films = backlight.maps("films", "films, from the plate upwards");
  leave_aside(root, "backlight");
  leave_aside(backlight, "films");
  if (films.empty()) {
    document.finish();
    throw core::ConfigError(
        core::Fault{document.name(), 0, 0, "", "must hold a map film or a list backlight.films, got neither"});
  }
  if (!index && films.size() > 1) {
    refuse_index(
        fmt::format("must say which of the films 0 to {} of {}, got nothing", films.size() - 1, document.name()));
  }
  const auto at = static_cast<std::size_t>(index.value_or(0));
  if (at >= films.size()) {
    refuse_index(fmt::format("must be at most {}, the last film of {}, got {}", films.size() - 1, document.name(), at));
  }
  for (std::size_t i = 0; i < films.size(); ++i) {
    if (i != at) films[i].mark_read();
  }
  return film_registry().make(films[at]);
}

}  // namespace

Film read_swept_film(const std::filesystem::path& file, std::optional<int> index,
                     const std::vector<ConfigDocument::Override>& changes) {
  ConfigDocument document = ConfigDocument::load(file);
  for (const auto& change : changes) document.apply(change);
  const ConfigNode root = document.root();
  std::optional<Film> film;
  if (root.has("film")) {
    if (index) refuse_index("must not be given for a file that holds one film, got " + std::to_string(*index));
    root.integer({"evenglow", "version of this format, 1", 1, 1, 1});
    root.text({"title", "one line for the reader", document.name()});
    film = film_registry().make(root.map("film", "the film"));
  } else {
    film = film_of_run_file(document, index);
  }
  document.finish();
  return std::move(film.value());
}

}  // namespace evenglow::tracer

#pragma once

#include <string>
#include <utility>

#include "core/config/config_node.h"
#include "tracer/films/film_registry.h"

/// Films from the text that a run file holds.
namespace evenglow::tests {

/// Throws `core::ConfigError` for every fault.
inline tracer::Film film_from(const std::string& flow_yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("film: " + flow_yaml, "run.yaml");
  auto film = tracer::film_registry().make(document.root().map("film", "a film", true));
  document.finish();
  return std::move(film.value());
}

/// Its faults, or "accepted".
inline std::string film_faults(const std::string& flow_yaml) {
  try {
    film_from(flow_yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace evenglow::tests

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_node.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// One film out of a file: of the map `film` at the top (written as an entry of `backlight.films`; beside it only
/// `evenglow` and `title`), or entry `index` (from 0) of `backlight.films` of a run file, whose other keys are not
/// judged. A run file with one film needs no index. Throws `core::ConfigError` with all faults.
Film read_swept_film(const std::filesystem::path& file, std::optional<int> index,
                     const std::vector<core::ConfigDocument::Override>& changes);

}  // namespace evenglow::tracer

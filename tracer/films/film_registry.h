#pragma once

#include "core/config/registry.h"
#include "tracer/films/film.h"

namespace evenglow::tracer {

/// The kinds of films. Each reads all keys of its node, so an entry of the list `films` is
/// `film_registry().make(node)`; every kind has `gap_mm`, the air below the film.
const core::Registry<Film>& film_registry();

}  // namespace evenglow::tracer

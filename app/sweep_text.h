#pragma once

#include <string>
#include <vector>

#include "tracer/goniometer/film_sweep.h"

namespace evenglow::app {

/// All rows: a comment with units, then the columns of docs/films.md ("A sweep over angles"). Entries that there are
/// not (the state of straight light where there is none) are empty. `what` names the film in the comment.
std::string sweep_csv(const std::vector<tracer::SweepRow>& rows, const std::string& what, bool from_above);

/// For stdout: the first rows (at most 60) in columns, standard errors where there are any.
std::string sweep_table(const std::vector<tracer::SweepRow>& rows);

}  // namespace evenglow::app

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "tracer/polarized_bsdf/lobe_fit.h"
#include "tracer/polarized_bsdf/lobe_model.h"

namespace evenglow::app {

/// For stdout: parameters with standard errors, chi-square, metrics, what the readings do not tell.
std::string fit_summary(const tracer::LobeFit& fit, std::size_t readings);
std::string validation_summary(const tracer::CrossValidation& validation);
/// R and T of pass and block light against the angle of incidence.
std::string hemispherical_summary(const tracer::LobeModel& film);

/// A run file for `evenglow film goniometer` that puts the fitted film against the readings; its map `model` is what a
/// film of kind `dbef` takes. `path`: where it will stand; the tables are named from there.
std::string fitted_run_file(const tracer::LobeFit& fit, const std::filesystem::path& path,
                            const std::filesystem::path& reflection, const std::filesystem::path& transmission);

}  // namespace evenglow::app

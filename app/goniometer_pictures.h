#pragma once

#include <filesystem>

#include "tracer/goniometer/goniometer.h"

namespace evenglow::app {

/// bsdf.png: BSDF against theta behind a polarizer at 0, 45, 90 and 135 degrees, reflection and transmission, film at
/// the first psi (figure 5 of the DBEF paper). reflection.png, transmission.png: the luminance tables as curves, one
/// panel for each psi (the first three): lines evaluated, discs measured, rings traced, dashes published. Throws
/// `core::Error`.
void write_goniometer_pictures(const tracer::GoniometerSpec& spec, const tracer::GoniometerResult& result,
                               const std::filesystem::path& directory);

}  // namespace evenglow::app

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracer/goniometer/film_sweep.h"

namespace evenglow::app {

/// Two panels, transmittance and reflectance, against that of angle of incidence, azimuth and wavelength which has the
/// most values; the others at their first. One curve for each polarization, lines into the hemisphere, dashes the
/// specular part of films that scatter. Throws `core::Error`.
void write_sweep_picture(const std::vector<tracer::SweepRow>& rows, const std::string& heading,
                         const std::filesystem::path& path);

}  // namespace evenglow::app

#pragma once

#include <filesystem>

#include "app/dots_report.h"

namespace evenglow::app {

/// dots.png (the whole plate, what part of each pixel is under dots), dots_zoom.png (three places: few, middling and
/// many dots) and dots_spectrum.png (power spectrum: map and radial mean). Throws core::Error if one cannot be written.
void write_dots_pictures(const DotsReport& report, const std::filesystem::path& directory);

}  // namespace evenglow::app

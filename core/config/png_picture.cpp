#include <array>
#include <cstdint>
#include <fstream>
#include <memory>

#include <cairo.h>
#include <fmt/core.h>

#include "core/base/error.h"
#include "core/config/matrix_file.h"

namespace evenglow::core {
namespace {

constexpr std::uint32_t kMostPixels = 4096;  // along each side

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw ConfigError(Fault{file.string(), 0, 0, "", message});
}

/// Width and height stand at fixed places in the first chunk: a huge picture is refused before memory is spent on it.
void check_size(const std::filesystem::path& file) {
  std::array<unsigned char, 24> head{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(head.data()), head.size());
  constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};
  if (!in || !std::equal(kSignature.begin(), kSignature.end(), head.begin())) refuse(file, "must be a PNG picture");
  const auto big_endian = [&](std::size_t at) {
    return std::uint32_t{head[at]} << 24 | std::uint32_t{head[at + 1]} << 16 | std::uint32_t{head[at + 2]} << 8 |
           head[at + 3];
  };
  const std::uint32_t width = big_endian(16);
  const std::uint32_t height = big_endian(20);
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels) {
    refuse(file, fmt::format("must have at most {} x {} pixels, got {} x {}", kMostPixels, kMostPixels, width, height));
  }
}

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

}  // namespace

NumberMatrix read_png_picture(const std::filesystem::path& file) {
  check_size(file);
  const std::unique_ptr<cairo_surface_t, SurfaceDeleter> picture(cairo_image_surface_create_from_png(file.c_str()));
  if (cairo_surface_status(picture.get()) != CAIRO_STATUS_SUCCESS) {
    refuse(file,
           fmt::format("must be a PNG picture, got: {}", cairo_status_to_string(cairo_surface_status(picture.get()))));
  }
  const cairo_format_t format = cairo_image_surface_get_format(picture.get());
  if (format != CAIRO_FORMAT_ARGB32 && format != CAIRO_FORMAT_RGB24)
    refuse(file, "must be a PNG picture of 8 bits a color");
  NumberMatrix matrix;
  matrix.nx = cairo_image_surface_get_width(picture.get());
  matrix.ny = cairo_image_surface_get_height(picture.get());
  const unsigned char* data = cairo_image_surface_get_data(picture.get());
  const int stride = cairo_image_surface_get_stride(picture.get());
  for (int iy = matrix.ny - 1; iy >= 0; --iy) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + static_cast<std::ptrdiff_t>(iy) * stride);
    for (int ix = 0; ix < matrix.nx; ++ix) {
      const std::uint32_t pixel = row[ix];
      matrix.values.push_back(((pixel >> 16 & 0xFFU) + (pixel >> 8 & 0xFFU) + (pixel & 0xFFU)) / 765.0);
    }
  }
  return matrix;
}

}  // namespace evenglow::core

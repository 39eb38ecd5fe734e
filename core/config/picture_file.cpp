#include <array>
#include <fstream>
#include <string>

#include "core/base/error.h"
#include "core/config/matrix_file.h"

namespace evenglow::core {
namespace {

enum class PictureKind { kNone, kPng, kTiff };

PictureKind kind_of(const std::filesystem::path& file) {
  std::array<char, 4> head{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return PictureKind::kNone;  // never waits on a pipe
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), head.size());
  const std::string start(head.data(), static_cast<std::size_t>(in.gcount()));
  if (start == "\x89PNG") return PictureKind::kPng;
  if (start == std::string("II*\0", 4) || start == std::string("MM\0*", 4)) return PictureKind::kTiff;
  return PictureKind::kNone;
}

}  // namespace

bool is_picture(const std::filesystem::path& file) {
  return kind_of(file) != PictureKind::kNone;
}

NumberMatrix read_picture(const std::filesystem::path& file) {
  if (!is_picture(file)) {
    throw ConfigError(Fault{file.string(), 0, 0, "", "must be a PNG or TIFF picture"});
  }
  return kind_of(file) == PictureKind::kPng ? read_png_picture(file) : read_tiff_picture(file);
}

}  // namespace evenglow::core

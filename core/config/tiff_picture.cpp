#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>

#include <fmt/core.h>
#include <tiffio.h>

#include "core/base/error.h"
#include "core/config/matrix_file.h"
#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

constexpr std::uint32_t kMostPixels = 4096;  // along each side

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw ConfigError(Fault{file.string(), 0, 0, "", message});
}

struct Closer {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
struct OptionsFreer {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

/// Keeps the first message of the library instead of printing it.
int keep_message(TIFF*, void* to, const char*, const char* format, va_list values) {
  auto& message = *static_cast<std::string*>(to);
  std::array<char, 200> text{};
  if (message.empty() && std::vsnprintf(text.data(), text.size(), format, values) > 0) message = text.data();
  return 1;
}

class TiffFile {
 public:
  explicit TiffFile(const std::filesystem::path& file) : file_(file) {
    const std::unique_ptr<TIFFOpenOptions, OptionsFreer> options(TIFFOpenOptionsAlloc());
    constexpr tmsize_t kMostBytes = tmsize_t{256} << 20;
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostBytes);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &message_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_message, &ignored_);
    tiff_.reset(TIFFOpenExt(file.c_str(), "r", options.get()));
    if (!tiff_) damaged();
    TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &width_);
    TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &height_);
    if (width_ < 1 || height_ < 1 || width_ > kMostPixels || height_ > kMostPixels) {
      refuse(file,
             fmt::format("must have at most {} x {} pixels, got {} x {}", kMostPixels, kMostPixels, width_, height_));
    }
  }

  NumberMatrix read() {
    NumberMatrix matrix;
    matrix.nx = static_cast<int>(width_);
    matrix.ny = static_cast<int>(height_);
    matrix.values.resize(std::size_t{width_} * height_);
    if (!is_gray()) {
      read_colors(matrix);
    } else if (bits() == 8) {
      read_gray<std::uint8_t>(matrix);
    } else if (bits() == 16) {
      read_gray<std::uint16_t>(matrix);
    } else {
      read_gray<float>(matrix);
    }
    return matrix;
  }

 private:
  [[noreturn]] void damaged() const {
    refuse(file_, "must be a TIFF picture, got: " + (message_.empty() ? "a damaged one" : one_line(message_)));
  }

  std::uint16_t field(ttag_t tag) const {
    std::uint16_t value = 0;
    TIFFGetFieldDefaulted(tiff_.get(), tag, &value);
    return value;
  }
  std::uint16_t bits() const { return field(TIFFTAG_BITSPERSAMPLE); }

  /// One number a pixel, in rows: what `read_gray` knows.
  bool is_gray() const {
    const std::uint16_t photometric = field(TIFFTAG_PHOTOMETRIC);
    const bool gray = photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
    const bool real = field(TIFFTAG_SAMPLEFORMAT) == SAMPLEFORMAT_IEEEFP;
    const bool known = real ? bits() == 32 : bits() == 8 || bits() == 16;
    return gray && known && field(TIFFTAG_SAMPLESPERPIXEL) == 1 && TIFFIsTiled(tiff_.get()) == 0;
  }

  template <typename Sample>
  void read_gray(NumberMatrix& matrix) {
    if (TIFFScanlineSize(tiff_.get()) != static_cast<tmsize_t>(width_ * sizeof(Sample))) damaged();
    const bool white_is_zero = field(TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISWHITE;
    std::vector<Sample> row(width_);
    for (std::uint32_t iy = 0; iy < height_; ++iy) {
      if (TIFFReadScanline(tiff_.get(), row.data(), iy, 0) != 1) damaged();
      double* to = matrix.values.data() + std::size_t{height_ - 1 - iy} * width_;
      for (std::uint32_t ix = 0; ix < width_; ++ix) to[ix] = brightness(row[ix], white_is_zero, ix, iy);
    }
  }

  template <typename Sample>
  double brightness(Sample sample, bool white_is_zero, std::uint32_t ix, std::uint32_t iy) const {
    double value = static_cast<double>(sample);
    if constexpr (std::is_integral_v<Sample>) value /= static_cast<double>(static_cast<Sample>(~Sample{0}));
    if (!(value >= 0.0 && value <= 1.0)) {
      refuse(file_, fmt::format("must hold numbers in [0, 1], got {:g} in column {}, row {} from the top", value,
                                ix + 1, iy + 1));
    }
    return white_is_zero ? 1.0 - value : value;
  }

  void read_colors(NumberMatrix& matrix) {
    std::vector<std::uint32_t> pixels(matrix.values.size());
    if (TIFFReadRGBAImageOriented(tiff_.get(), width_, height_, pixels.data(), ORIENTATION_BOTLEFT, 1) != 1) damaged();
    std::transform(pixels.begin(), pixels.end(), matrix.values.begin(),
                   [](std::uint32_t pixel) { return (TIFFGetR(pixel) + TIFFGetG(pixel) + TIFFGetB(pixel)) / 765.0; });
  }

  std::filesystem::path file_;
  std::string message_, ignored_;
  std::unique_ptr<TIFF, Closer> tiff_;
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace

NumberMatrix read_tiff_picture(const std::filesystem::path& file) {
  return TiffFile(file).read();
}

}  // namespace evenglow::core

#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include "core/base/error.h"
#include "core/config/matrix_file.h"
#include "tests/support/program.h"

namespace evenglow::core {
namespace {

using testing::HasSubstr;

struct Layout {
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint16_t compression = COMPRESSION_LZW;
  std::uint16_t samples = 1;
};

class TiffPicture : public testing::Test {
 protected:
  /// Two rows of three pixels, the upper row first.
  template <typename Sample>
  std::filesystem::path written(const std::vector<Sample>& pixels, const Layout& layout = {}) {
    const auto path = folder_ / "map.tif";
    TIFF* tiff = TIFFOpen(path.c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 3);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 2);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8 * sizeof(Sample));
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, layout.samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, std::is_integral_v<Sample> ? SAMPLEFORMAT_UINT : SAMPLEFORMAT_IEEEFP);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, layout.photometric);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, layout.compression);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 1);
    for (std::uint32_t row = 0; row < 2; ++row) {
      std::vector<Sample> line(pixels.begin() + 3 * layout.samples * row,
                               pixels.begin() + 3 * layout.samples * (row + 1));
      TIFFWriteScanline(tiff, line.data(), row, 0);
    }
    TIFFClose(tiff);
    return path;
  }
  std::string refusal(const std::filesystem::path& path) {
    try {
      read_tiff_picture(path);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  tests::TempFolder folder_;
};

TEST_F(TiffPicture, ReadsGrayOfEightAndSixteenBitsFromTheLowestRow) {
  const NumberMatrix eight = read_tiff_picture(written<std::uint8_t>({0, 51, 255, 102, 153, 204}));
  EXPECT_EQ(eight.nx, 3);
  EXPECT_EQ(eight.ny, 2);
  const std::vector<double> expected{0.4, 0.6, 0.8, 0.0, 0.2, 1.0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(eight.values[i], expected[i], 1e-15);
  const NumberMatrix sixteen = read_picture(written<std::uint16_t>({0, 1, 65535, 2, 3, 13107}));
  EXPECT_DOUBLE_EQ(sixteen.values[4], 1.0 / 65535.0);
  EXPECT_DOUBLE_EQ(sixteen.values[2], 0.2);
}

TEST_F(TiffPicture, WhiteMayBeZero) {
  const NumberMatrix map =
      read_tiff_picture(written<std::uint8_t>({0, 0, 0, 255, 255, 51}, {.photometric = PHOTOMETRIC_MINISWHITE}));
  EXPECT_DOUBLE_EQ(map.values[2], 0.8);
  EXPECT_DOUBLE_EQ(map.values[3], 1.0);
}

TEST_F(TiffPicture, FloatingPointNumbersCountAsTheyAre) {
  const NumberMatrix map = read_tiff_picture(written<float>({0.0F, 0.25F, 1.0F, 0.5F, 0.125F, 0.75F}));
  EXPECT_EQ(map.values, (std::vector<double>{0.5, 0.125, 0.75, 0.0, 0.25, 1.0}));
  EXPECT_THAT(refusal(written<float>({0.0F, 0.25F, 1.5F, 0.5F, 0.125F, 0.75F})),
              HasSubstr("map.tif: must hold numbers in [0, 1], got 1.5 in column 3, row 1 from the top"));
}

TEST_F(TiffPicture, ColorsCountByTheirMean) {
  const std::vector<std::uint8_t> pixels{255, 0, 0, 0, 0, 0, 255, 255, 255, 51, 51, 51, 0, 255, 255, 0, 0, 255};
  const NumberMatrix map = read_tiff_picture(written(pixels, {.photometric = PHOTOMETRIC_RGB, .samples = 3}));
  EXPECT_NEAR(map.values[0], 0.2, 1e-12);
  EXPECT_NEAR(map.values[1], 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(map.values[3], 1.0 / 3.0, 1e-12);
}

/// Every cut and many flipped bytes: read or refused in one line, never a crash.
TEST_F(TiffPicture, DamagedFilesAreRefusedInOneLine) {
  const auto path = written<std::uint16_t>({0, 1, 65535, 2, 3, 13107});
  const std::string good = tests::file_text(path);
  for (std::size_t length = 4; length < good.size(); ++length) {
    tests::write_text(path, good.substr(0, length));
    const std::string told = refusal(path);
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  }
  for (std::size_t i = 4; i < good.size(); ++i) {
    for (const char flip : {'\x01', '\x80', '\x7f'}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ flip);
      tests::write_text(path, bad);
      EXPECT_EQ(refusal(path).find('\n'), std::string::npos);
    }
  }
  tests::write_text(path, "no picture");
  EXPECT_THROW(read_picture(path), ConfigError);
  EXPECT_FALSE(is_picture(path));
}

}  // namespace
}  // namespace evenglow::core

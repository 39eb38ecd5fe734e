#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <tiffio.h>

#include "core/base/error.h"
#include "core/config/matrix_file.h"
#include "tests/support/program.h"

/// Which reader a picture is given to; what the readers make of it: png_picture_test, tiff_picture_test.
namespace evenglow::core {
namespace {

using testing::HasSubstr;

/// Gray of 8 bits, 2 x 2: white and black above 51 and 204.
const std::string kPng(
    "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00\x00\x02\x08\x00\x00\x00"
    "\x00\x57\xdd\x52\xf8\x00\x00\x00\x0e\x49\x44\x41\x54\x78\xda\x63\xf8\xcf\xc0\x60\x7c\x06\x00\x06\x33\x01\xff\x82"
    "\x3b\x97\x67\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
    71);
const std::vector<double> kPixels{0.2, 0.8, 1.0, 0.0};  // the lowest row first

class PictureFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    tests::write_text(folder_ / name, bytes);
    return folder_ / name;
  }
  /// The same pixels; `order`: `l` Intel's (II), `b` Motorola's (MM).
  std::filesystem::path tiff(const std::string& name, const std::string& order) const {
    TIFF* out = TIFFOpen((folder_ / name).c_str(), ("w" + order).c_str());
    TIFFSetField(out, TIFFTAG_IMAGEWIDTH, 2);
    TIFFSetField(out, TIFFTAG_IMAGELENGTH, 2);
    TIFFSetField(out, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(out, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(out, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(out, TIFFTAG_ROWSPERSTRIP, 2);
    std::array<unsigned char, 2> upper{255, 0}, lower{51, 204};
    TIFFWriteScanline(out, upper.data(), 0, 0);
    TIFFWriteScanline(out, lower.data(), 1, 0);
    TIFFClose(out);
    return folder_ / name;
  }
  static std::string refusal(const std::filesystem::path& path) {
    try {
      read_picture(path);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  tests::TempFolder folder_;
};

TEST_F(PictureFile, EachKindIsReadWhateverItsName) {
  for (const auto& path : {file("density.csv", kPng), tiff("intel.png", "l"), tiff("motorola", "b")}) {
    EXPECT_TRUE(is_picture(path)) << path;
    const NumberMatrix map = read_picture(path);
    EXPECT_EQ(map.nx, 2) << path;
    EXPECT_EQ(map.ny, 2) << path;
    ASSERT_EQ(map.values.size(), kPixels.size());
    for (std::size_t i = 0; i < kPixels.size(); ++i) EXPECT_NEAR(map.values[i], kPixels[i], 1e-12) << path << i;
  }
  EXPECT_EQ(tests::file_text(folder_ / "intel.png").substr(0, 2), "II");
  EXPECT_EQ(tests::file_text(folder_ / "motorola").substr(0, 2), "MM");
}

TEST_F(PictureFile, WhatDoesNotBeginAsAPictureIsNone) {
  using std::string_literals::operator""s;
  for (const std::string& bytes : {""s, "0.1,0.2\n"s, "\x89PN"s, "II"s, "II*"s, "II+\0"s, "MM*\0"s, "PNG\x89"s}) {
    const auto path = file("map.png", bytes);
    EXPECT_FALSE(is_picture(path)) << bytes;
    EXPECT_THAT(refusal(path), HasSubstr("map.png: must be a PNG or TIFF picture")) << bytes;
  }
}

TEST_F(PictureFile, WhatBeginsAsAPictureOnlyIsRefusedByItsReader) {
  for (const std::string& bytes : {std::string("\x89PNG"), std::string("II*\0", 4), std::string("MM\0*", 4)}) {
    const auto path = file("map.png", bytes);
    EXPECT_TRUE(is_picture(path));
    EXPECT_THAT(refusal(path), HasSubstr("map.png"));
    EXPECT_THAT(refusal(path), testing::Not(HasSubstr("PNG or TIFF")));
  }
}

/// A pipe would keep the reader waiting for ever.
TEST_F(PictureFile, NoFileIsNoPicture) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const auto& path : {folder_ / "missing", folder_.path(), folder_ / "pipe"}) {
    EXPECT_FALSE(is_picture(path)) << path;
    EXPECT_THAT(refusal(path), HasSubstr("must be a PNG or TIFF picture")) << path;
  }
}

}  // namespace
}  // namespace evenglow::core

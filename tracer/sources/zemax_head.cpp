#include <array>

#include <fmt/format.h>

#include "tracer/sources/binary_file.h"
#include "tracer/sources/ray_file_layout.h"

/// The binary source file of Zemax OpticStudio (its help: "Source File", "Binary Source File Format"). All numbers 32
/// bits, little-endian.
///
/// | byte | what |
/// | --- | --- |
/// | 0 | identifier 1010 (8675309 in old files), number of rays |
/// | 8 | description (100 characters) |
/// | 108 | source flux, ray set flux, wavelength, inclinations and azimuths (2 each) |
/// | 136 | unit: 0 m, 1 in, 2 cm, 3 ft, 4 mm |
/// | 140 | location, rotation, scale (3 each), 4 not used |
/// | 192 | format of the rays: 0 flux only, 2 spectral color; flux: 0 W, 1 lm; 2 not used |
/// | 208 | rays: x, y, z, l, m, n, flux, and the wavelength in the spectral color format |
///
/// As in OpticStudio, only the number of rays, the unit, the format and the kind of flux count.
namespace evenglow::tracer {
namespace {

constexpr std::uint64_t kHeadBytes = 208;
constexpr std::array<double, 5> kMmPerUnit{1000.0, 25.4, 10.0, 304.8, 1.0};

}  // namespace

RayFileLayout read_zemax_head(const std::filesystem::path& path) {
  const BinaryFile file(path);
  if (file.size() < kHeadBytes) {
    file.refuse(
        fmt::format("must be at least {} bytes long, the head of a Zemax ray file, got {}", kHeadBytes, file.size()));
  }
  std::array<std::byte, kHeadBytes> bytes{};
  file.read(0, bytes);
  const auto integer = [&](std::size_t at) { return little_endian<std::int32_t>(bytes.data() + at); };
  if (integer(0) != 1010 && integer(0) != 8675309) {
    file.refuse(fmt::format("must begin with the identifier 1010 or 8675309 of a Zemax ray file, got {}", integer(0)));
  }
  RayFileLayout layout;
  layout.format = "zemax";
  layout.first_byte = kHeadBytes;
  layout.rays = little_endian<std::uint32_t>(bytes.data() + 4);
  const int unit = integer(136);
  if (unit < 0 || unit > 4) file.refuse(fmt::format("unit of length: must lie in [0, 4], got {}", unit));
  layout.mm_per_unit = kMmPerUnit[static_cast<std::size_t>(unit)];
  const int format = integer(192);
  if (format != 0 && format != 2) {
    file.refuse(fmt::format("format of the rays: must be 0 (flux only) or 2 (spectral color), got {}", format));
  }
  const int kind = integer(196);
  if (kind != 0 && kind != 1) file.refuse(fmt::format("kind of flux: must be 0 (W) or 1 (lm), got {}", kind));
  layout.columns = format == 2 ? 8 : 7;
  layout.lumens = format == 0 && kind == 1;
  const std::uint64_t room = file.size() - kHeadBytes;
  if (layout.rays == 0 || room != layout.rays * layout.record_bytes()) {
    file.refuse(fmt::format("must hold {} rays of {} bytes from byte {} to its end, got {} bytes there", layout.rays,
                            layout.record_bytes(), kHeadBytes, room));
  }
  return layout;
}

RayFileLayout read_ray_file_head(const std::filesystem::path& path, const std::string& format) {
  if (format == "tm25") return read_tm25_head(path);
  if (format == "zemax") return read_zemax_head(path);
  const BinaryFile file(path);
  if (file.size() < 4) file.refuse("must be a TM-25 or Zemax ray file, got less than 4 bytes");
  std::array<std::byte, 4> bytes{};
  file.read(0, bytes);
  if (std::memcmp(bytes.data(), "TM25", 4) == 0) return read_tm25_head(path);
  const auto mark = little_endian<std::int32_t>(bytes.data());
  if (mark == 1010 || mark == 8675309) return read_zemax_head(path);
  file.refuse("must be a TM-25 or Zemax ray file, got neither's mark at its beginning");
}

}  // namespace evenglow::tracer

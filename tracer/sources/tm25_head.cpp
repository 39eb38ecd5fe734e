#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tracer/sources/binary_file.h"
#include "tracer/sources/ray_file_layout.h"

/// IES TM-25-13, section 4.7. All numbers little-endian, 32 bits but for the count of rays.
///
/// | byte | what |
/// | --- | --- |
/// | 0 | `TM25`, version 2013, creation method |
/// | 12 | luminous flux (lm), radiant flux (W), number of rays (64 bits) |
/// | 28 | date (28 characters), start position flag |
/// | 60 | spectral data identifier 0 to 4; wavelength, least and largest wavelength |
/// | 76 | number of spectral tables, of additional items, bytes of additional text |
/// | 256 | flags: position, direction, radiant flux, wavelength, luminous flux, Stokes, tristimulus, spectrum index |
/// | 288 | nine texts of 1000 characters of 32 bits |
/// | 36288 | tables: number of pairs, pairs; filled up to a multiple of 32 bytes; names of the items, 512 bytes each;
/// text |
namespace evenglow::tracer {
namespace {

constexpr std::uint64_t kTables = 36288;
constexpr std::uint64_t kNameBytes = 512;
constexpr int kMaxItems = 1000;
constexpr int kMaxTables = 100000;
constexpr int kMaxPairs = 1000000;

class Head {
 public:
  explicit Head(const BinaryFile& file) : file_(file) {
    if (file.size() < kTables) {
      file.refuse(
          fmt::format("must be at least {} bytes long, the head of a TM-25 file, got {}", kTables, file.size()));
    }
    file.read(0, bytes_);
  }

  int integer(std::size_t at) const { return little_endian<std::int32_t>(bytes_.data() + at); }
  float real(std::size_t at) const { return little_endian<float>(bytes_.data() + at); }
  std::uint64_t rays() const { return little_endian<std::uint64_t>(bytes_.data() + 20); }

  int integer(std::size_t at, const char* what, int min, int max) const {
    const int value = integer(at);
    if (value < min || value > max) {
      file_.refuse(fmt::format("{}: must lie in [{}, {}], got {}", what, min, max, value));
    }
    return value;
  }

  bool flag(std::size_t index, const char* what, int min = 0) const {
    return integer(256 + 4 * index, what, min, 1) == 1;
  }

  /// A flux of the head: NaN or zero if not known.
  double flux(std::size_t at, const char* what) const {
    const double value = real(at);
    if (value < 0.0 || std::isinf(value)) file_.refuse(fmt::format("{}: must not be negative, got {}", what, value));
    return value > 0.0 ? value : 0.0;
  }

 private:
  const BinaryFile& file_;
  std::array<std::byte, 288> bytes_{};
};

/// The end of the spectral tables, with their filling.
std::uint64_t end_of_tables(const BinaryFile& file, int tables) {
  std::uint64_t at = kTables;
  for (int i = 0; i < tables; ++i) {
    std::array<std::byte, 4> bytes{};
    if (at + 4 > file.size()) file.refuse(fmt::format("must hold {} spectral tables, got the end of the file", tables));
    file.read(at, bytes);
    const int pairs = little_endian<std::int32_t>(bytes.data());
    if (pairs < 1 || pairs > kMaxPairs) {
      file.refuse(fmt::format("pairs of spectral table {}: must lie in [1, {}], got {}", i + 1, kMaxPairs, pairs));
    }
    at += 4 + 8 * static_cast<std::uint64_t>(pairs);
  }
  return (at - kTables + 31) / 32 * 32 + kTables;
}

/// The columns of a record in the order of the standard: radiant flux, wavelength, luminous flux, S1 to S3 and their
/// axis, tristimulus X and Z, spectrum index, additional items.
void read_columns(const Head& head, int items, RayFileLayout& layout, const BinaryFile& file) {
  head.flag(0, "position flag", 1);
  head.flag(1, "direction flag", 1);
  const bool radiant = head.flag(2, "radiant flux flag");
  const bool wavelength = head.flag(3, "wavelength flag");
  const bool luminous = head.flag(4, "luminous flux flag");
  const bool stokes = head.flag(5, "Stokes flag");
  const bool tristimulus = head.flag(6, "tristimulus flag");
  const bool index = head.flag(7, "spectrum index flag");
  if (!radiant && !luminous) file.refuse("must hold the radiant or the luminous flux of its rays, got neither");
  int next = 6;
  if (radiant) layout.flux = next++;
  if (wavelength) ++next;
  if (luminous) layout.flux = next++;
  layout.lumens = luminous;
  if (stokes) {
    layout.stokes = next;
    next += 6;
  }
  if (tristimulus) next += 2;
  if (index) ++next;
  layout.columns = next + items;
}

}  // namespace

RayFileLayout read_tm25_head(const std::filesystem::path& path) {
  const BinaryFile file(path);
  const Head head(file);
  if (head.integer(0) != 0x35324D54) file.refuse("must begin with TM25, the mark of a TM-25 ray file");
  if (head.integer(4) != 2013) file.refuse(fmt::format("version: must be 2013 (TM-25-13), got {}", head.integer(4)));
  RayFileLayout layout;
  layout.format = "tm25";
  layout.rays = head.rays();
  const double luminous = head.flux(12, "luminous flux");
  head.flux(16, "radiant flux");
  if (luminous > 0.0) layout.head_flux = luminous;
  const int tables = head.integer(76, "number of spectral tables", 0, kMaxTables);
  const int items = head.integer(80, "number of additional items", 0, kMaxItems);
  const int text = head.integer(84, "size of the additional text", 0, 1 << 28);
  head.integer(60, "spectral data identifier", 0, 4);
  read_columns(head, items, layout, file);
  layout.first_byte =
      end_of_tables(file, tables) + kNameBytes * static_cast<std::uint64_t>(items) + static_cast<std::uint64_t>(text);
  const std::uint64_t room = file.size() > layout.first_byte ? file.size() - layout.first_byte : 0;
  if (room % layout.record_bytes() != 0 || layout.rays != room / layout.record_bytes() || layout.rays == 0) {
    file.refuse(fmt::format("must hold {} rays of {} bytes from byte {} to its end, got {} bytes there", layout.rays,
                            layout.record_bytes(), layout.first_byte, room));
  }
  return layout;
}

}  // namespace evenglow::tracer

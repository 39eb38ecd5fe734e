#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::design {

/// Records of the GDSII stream format, big-endian: 2 bytes length, type and kind of data, the data.
class GdsRecords {
 public:
  enum class Type : std::uint16_t {
    header = 0x0002,
    begin_library = 0x0102,
    library_name = 0x0206,
    units = 0x0305,
    end_library = 0x0400,
    begin_structure = 0x0502,
    structure_name = 0x0606,
    end_structure = 0x0700,
    boundary = 0x0800,
    reference = 0x0A00,
    layer = 0x0D02,
    data_type = 0x0E02,
    points = 0x1003,
    end_element = 0x1100,
    referred_name = 0x1206,
  };

  void add(Type type);
  void add(Type type, const std::vector<std::int16_t>& values);
  void add(Type type, const std::vector<std::int32_t>& values);
  void add(Type type, const std::vector<double>& values);  ///< 8-byte reals: sign, power of 16 + 64, fraction
  void add(Type type, std::string_view text);              ///< padded to an even length

  std::string_view bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  void begin(Type type, std::size_t data_size);
  void put(std::uint64_t value, int count);

  std::string bytes_;
};

/// A number as an 8-byte real of the format (IBM's base 16). Powers of 16 outside [-64, 63] do not occur here.
std::uint64_t gds_real(double value);

}  // namespace evenglow::design

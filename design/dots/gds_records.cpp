#include "design/dots/gds_records.h"

#include <cmath>

namespace evenglow::design {

std::uint64_t gds_real(double value) {
  if (value == 0.0) return 0;
  int power = 0;
  double fraction = std::abs(value);
  while (fraction >= 1.0) {
    fraction /= 16.0;
    ++power;
  }
  while (fraction < 1.0 / 16.0) {
    fraction *= 16.0;
    --power;
  }
  auto digits = static_cast<std::uint64_t>(std::llround(std::ldexp(fraction, 56)));
  if (digits == std::uint64_t{1} << 56) {  // rounded up to 1
    digits >>= 4;
    ++power;
  }
  const std::uint64_t sign = value < 0.0 ? std::uint64_t{1} << 63 : 0;
  return sign | static_cast<std::uint64_t>(power + 64) << 56 | digits;
}

void GdsRecords::put(std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
}

void GdsRecords::begin(Type type, std::size_t data_size) {
  put(data_size + 4, 2);
  put(static_cast<std::uint64_t>(type), 2);
}

void GdsRecords::add(Type type) {
  begin(type, 0);
}

void GdsRecords::add(Type type, const std::vector<std::int16_t>& values) {
  begin(type, 2 * values.size());
  for (const std::int16_t value : values) put(static_cast<std::uint16_t>(value), 2);
}

void GdsRecords::add(Type type, const std::vector<std::int32_t>& values) {
  begin(type, 4 * values.size());
  for (const std::int32_t value : values) put(static_cast<std::uint32_t>(value), 4);
}

void GdsRecords::add(Type type, const std::vector<double>& values) {
  begin(type, 8 * values.size());
  for (const double value : values) put(gds_real(value), 8);
}

void GdsRecords::add(Type type, std::string_view text) {
  const std::size_t padded = text.size() + text.size() % 2;
  begin(type, padded);
  bytes_ += text;
  if (padded != text.size()) bytes_ += '\0';
}

}  // namespace evenglow::design

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

/// Ray files written from the definitions of their formats, for tests.
namespace evenglow::tests {

/// Bytes of a little-endian file.
class ByteWriter {
 public:
  template <typename Number>
  ByteWriter& put(Number value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    text_.append(bytes, sizeof(value));
    return *this;
  }
  ByteWriter& put(const std::vector<float>& values) {
    for (const float value : values) put(value);
    return *this;
  }
  ByteWriter& fill(std::size_t count) {
    text_.append(count, '\0');
    return *this;
  }
  ByteWriter& text(const std::string& value, std::size_t bytes) {
    text_ += value;
    return fill(bytes - value.size());
  }
  const std::string& bytes() const { return text_; }

 private:
  std::string text_;
};

using RayNumbers = std::vector<float>;

/// IES TM-25-13.
struct Tm25 {
  std::string mark = "TM25";
  std::int32_t version = 2013;
  float luminous = std::numeric_limits<float>::quiet_NaN();
  float radiant = std::numeric_limits<float>::quiet_NaN();
  std::array<std::int32_t, 8> flags{1, 1, 0, 0, 1, 0, 0, 0};  // position, direction, W, nm, lm, Stokes, XZ, index
  std::vector<std::vector<float>> tables;                     // wavelength, weight, wavelength, ...
  std::int32_t items = 0;
  std::int32_t text_bytes = 0;
  std::int32_t spectral = 0;
  std::vector<RayNumbers> rays;
  std::uint64_t told_rays = std::numeric_limits<std::uint64_t>::max();  ///< as given unless it is this
  std::int32_t told_tables = -1;

  std::string head() const {
    constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();
    ByteWriter w;
    w.text(mark, 4).put(version).put(std::int32_t{0}).put(luminous).put(radiant);
    w.put(told_rays == std::numeric_limits<std::uint64_t>::max() ? static_cast<std::uint64_t>(rays.size()) : told_rays);
    w.text("2026-01-01T00:00:00", 28).put(std::int32_t{0}).put(spectral).put(kNotKnown).put(kNotKnown).put(kNotKnown);
    w.put(told_tables >= 0 ? told_tables : static_cast<std::int32_t>(tables.size())).put(items).put(text_bytes);
    w.fill(168);
    for (const std::int32_t flag : flags) w.put(flag);
    w.fill(9 * 4000);
    std::size_t bytes = 0;
    for (const auto& table : tables) {
      w.put(static_cast<std::int32_t>(table.size() / 2)).put(table);
      bytes += 4 + 4 * table.size();
    }
    w.fill((32 - bytes % 32) % 32);
    w.fill(512 * static_cast<std::size_t>(items)).fill(static_cast<std::size_t>(text_bytes));
    return w.bytes();
  }

  std::string bytes() const {
    ByteWriter w;
    for (const RayNumbers& ray : rays) w.put(ray);
    return head() + w.bytes();
  }
};

/// Binary source file of Zemax.
struct Zemax {
  std::int32_t identifier = 1010;
  std::int32_t unit = 4;    ///< mm
  std::int32_t format = 0;  ///< flux only
  std::int32_t kind = 1;    ///< lm
  std::vector<RayNumbers> rays;
  std::uint32_t told_rays = std::numeric_limits<std::uint32_t>::max();

  std::string bytes() const {
    ByteWriter w;
    w.put(identifier);
    w.put(told_rays == std::numeric_limits<std::uint32_t>::max() ? static_cast<std::uint32_t>(rays.size()) : told_rays);
    w.text("written by a test", 100).put(1.0F).put(1.0F).put(0.55F).fill(16).put(unit).fill(36).fill(16);
    w.put(format).put(kind).fill(8);
    for (const RayNumbers& ray : rays) w.put(ray);
    return w.bytes();
  }
};

/// x, y, z, direction, flux.
inline RayNumbers ray(double x, double y, double z, double theta_deg, double phi_deg, double flux) {
  const double t = theta_deg * 3.14159265358979324 / 180.0;
  const double p = phi_deg * 3.14159265358979324 / 180.0;
  return {static_cast<float>(x),
          static_cast<float>(y),
          static_cast<float>(z),
          static_cast<float>(std::sin(t) * std::cos(p)),
          static_cast<float>(std::sin(t) * std::sin(p)),
          static_cast<float>(std::cos(t)),
          static_cast<float>(flux)};
}

}  // namespace evenglow::tests

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace evenglow::tracer {

/// A regular file that is read at any place, by any number of threads at once; nothing of it is kept in memory.
class BinaryFile {
 public:
  /// Throws `core::ConfigError` if it cannot be opened or is no regular file.
  explicit BinaryFile(const std::filesystem::path& file);
  ~BinaryFile();
  BinaryFile(BinaryFile&& other) noexcept;
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;
  BinaryFile& operator=(BinaryFile&&) = delete;

  std::uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }

  /// Fills `bytes` from the place `at`. Throws `core::Error` if the file has become shorter or cannot be read.
  void read(std::uint64_t at, std::span<std::byte> bytes) const;
  /// Faults the file as a whole.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  std::string name_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// A number out of bytes of a little-endian file.
template <typename Number>
Number little_endian(const std::byte* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

}  // namespace evenglow::tracer

#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace evenglow::tracer {

/// An HDF5 file made in memory: datasets of numbers in the root group and short attributes, with checksums
/// (readable by HDF5 1.10 and later), behind a user block of 512 bytes with the SHA-256 of the rest. Throws
/// `core::Error` if the library fails. The same calls give the same bytes.
class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// A dataset of doubles, last index fastest; `chunk` (empty: stored as one piece) compressed, with checksums.
  void numbers(const std::string& dataset, std::span<const std::size_t> shape, std::span<const std::size_t> chunk,
               std::span<const double> values);
  void text(const std::string& dataset, const char* attribute, const std::string& value);
  void integer(const std::string& dataset, const char* attribute, long long value);
  /// Of the whole file; once, as the last call.
  std::string bytes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evenglow::tracer

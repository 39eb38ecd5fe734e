#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::tracer {

/// An HDF5 file in memory, read: datasets of numbers in the root group and short attributes. With
/// `Hdf5Writer` the only place that knows the HDF5 library. One thread at a time.
///
/// Bounded: nothing larger than the caller's limit is read; chunks of at most 1 MiB, filters deflate, shuffle and
/// Fletcher-32 alone; no links to other files, no storage outside the file.
class Hdf5Reader {
 public:
  /// Throws `core::ConfigError`: no HDF5 file, cut short, damaged. `bytes` need not outlive the call.
  Hdf5Reader(std::string_view bytes, std::string name);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Names of all that the root group holds, sorted. Throws if that is not datasets alone.
  std::vector<std::string> datasets() const;
  /// Attribute of a dataset, or of the root group (`dataset` empty); none: absent. Throws: of another type.
  std::optional<std::string> text(const std::string& dataset, const char* attribute) const;
  std::optional<long long> integer(const std::string& dataset, const char* attribute) const;
  /// Sizes of a dataset of numbers. Throws: no simple array of real numbers.
  std::vector<std::size_t> shape(const std::string& dataset) const;
  /// The numbers, last index fastest. Throws: more than `most`, parts never written, damaged, storage not allowed.
  std::vector<double> numbers(const std::string& dataset, std::size_t most) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace evenglow::tracer

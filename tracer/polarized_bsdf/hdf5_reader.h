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
///
/// The library is not safe with damaged bytes. A file of `Hdf5Writer` has its SHA-256 in a user block and is verified
/// before the library sees it; one of other programs begins with the HDF5 signature (no user block) and has but the
/// checksums of the format.
class Hdf5Reader {
 public:
  /// Throws `core::ConfigError`: no HDF5 file, cut short, damaged, edited without its SHA-256. `bytes` need not outlive
  /// the call.
  Hdf5Reader(std::string_view bytes, std::string name);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// How many things the root group holds.
  std::size_t links() const;
  /// Does the root group hold this dataset? Throws: a damaged group; something of this name that is no dataset.
  bool has(const std::string& dataset) const;
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

#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>

#include <hdf5.h>

#include "core/base/sha256.h"

/// What the two sides of the HDF5 door share. Not for others: it shows the library.
namespace evenglow::tracer::hdf5 {

constexpr std::size_t kHdf5Increment = 1 << 16;  ///< bytes by which a file in memory grows

constexpr std::size_t kUserBlock = 512;  ///< bytes before the HDF5 file proper; the smallest that the format allows
constexpr std::string_view kUserBlockTitle = "Evenglow HDF5, SHA-256 of all after byte 512: ";

/// The user block of a written file: one line with the checksum of the bytes behind it, then zeros. The library is not
/// safe with damaged bytes, so that a file of ours is verified before the library sees it.
inline std::string user_block(std::string_view behind) {
  std::string block(kUserBlockTitle);
  block += core::sha256_hex(behind) + '\n';
  block.resize(kUserBlock, '\0');
  return block;
}

/// An identifier of the library, closed at the end of its life; negative: the call failed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: the library's functions take it
  bool failed() const { return id_ < 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library prints its errors to stderr unless told otherwise.
class Quiet {
 public:
  Quiet() {
    H5dont_atexit();  // what a damaged file leaves open would make the library complain at the end of the program
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// File access to bytes in memory (empty: a new file), to be closed with H5Pclose.
inline hid_t memory_access(std::string_view image) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, kHdf5Increment, 0);
  // Everything but the data itself with checksums; files that HDF5 1.10 and later read.
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  if (!image.empty()) H5Pset_file_image(access, const_cast<char*>(image.data()), image.size());
  return access;
}

/// A name that no other file in memory has: the library takes files of one name for one file.
inline std::string unique_name() {
  static std::atomic<unsigned> count{0};
  return "evenglow memory " + std::to_string(++count);
}

}  // namespace evenglow::tracer::hdf5

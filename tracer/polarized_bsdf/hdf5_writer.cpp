#include "tracer/polarized_bsdf/hdf5_writer.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <hdf5.h>

#include "core/base/error.h"
#include "tracer/polarized_bsdf/hdf5_library.h"

namespace evenglow::tracer {

using hdf5::Handle;

namespace {

constexpr int kDeflateLevel = 6;

void check(bool good, const char* what) {
  if (!good) throw core::Error(fmt::format("HDF5: cannot write {}", what));
}

/// Where the file ends; its memory is rounded up. Superblock (behind the user block) of version 2 or 3: bytes 28 to 35,
/// lowest first (HDF5 File Format Specification 3.0, II.A).
std::size_t end_of_file(const std::string& image) {
  std::size_t end = 0;
  for (std::size_t i = 8; i-- > 0;) end = end << 8 | static_cast<unsigned char>(image.at(hdf5::kUserBlock + 28 + i));
  return end;
}

/// The memory of the file, handed over when the library closes it. (`H5Fget_file_image` of an open file has a
/// superblock whose checksum is wrong.)
void* image_malloc(std::size_t size, H5FD_file_image_op_t, void*) {
  return std::malloc(size);
}
void* image_memcpy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}
void* image_realloc(void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::realloc(memory, size);
}
herr_t image_free(void* memory, H5FD_file_image_op_t operation, void* taken) {
  auto& image = *static_cast<std::string*>(taken);
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE) image.assign(static_cast<const char*>(memory), image.size());
  std::free(memory);
  return 0;
}
void* same_data(void* data) {
  return data;
}
herr_t keep_data(void*) {
  return 0;
}

}  // namespace

struct Hdf5Writer::Impl {
  hdf5::Quiet quiet{};
  hid_t file = -1;
  std::string image;  ///< its size is that of the file when it is closed

  ~Impl() {
    if (file >= 0) H5Fclose(file);
  }
  void attribute(const std::string& dataset, const char* name, hid_t type, const void* value) const {
    const Handle object(H5Oopen(file, dataset.empty() ? "/" : dataset.c_str(), H5P_DEFAULT), H5Oclose);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle id(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(!id.failed() && H5Awrite(id, type, value) >= 0, name);
  }
};

Hdf5Writer::Hdf5Writer() : impl_(std::make_unique<Impl>()) {
  const Handle access(hdf5::memory_access({}), H5Pclose);
  H5FD_file_image_callbacks_t callbacks{image_malloc, image_memcpy, image_realloc, image_free,
                                        same_data,    keep_data,    &impl_->image};
  check(H5Pset_file_image_callbacks(access, &callbacks) >= 0, "into memory");
  const Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(made, false);  // the same table, the same bytes
  check(H5Pset_userblock(made, hdf5::kUserBlock) >= 0, "a user block");
  impl_->file = H5Fcreate(hdf5::unique_name().c_str(), H5F_ACC_TRUNC, made, access);
  check(impl_->file >= 0, "a file");
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::numbers(const std::string& dataset, std::span<const std::size_t> shape,
                         std::span<const std::size_t> chunk, std::span<const double> values) {
  const std::vector<hsize_t> sizes(shape.begin(), shape.end());
  const std::vector<hsize_t> piece(chunk.begin(), chunk.end());
  const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
  const Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(made, false);
  if (!piece.empty()) {
    check(H5Pset_chunk(made, static_cast<int>(piece.size()), piece.data()) >= 0 && H5Pset_shuffle(made) >= 0 &&
              H5Pset_deflate(made, kDeflateLevel) >= 0 && H5Pset_fletcher32(made) >= 0,
          "chunks");
  }
  const Handle id(H5Dcreate2(impl_->file, dataset.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, made, H5P_DEFAULT),
                  H5Dclose);
  check(!id.failed() && H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
        dataset.c_str());
}

void Hdf5Writer::text(const std::string& dataset, const char* attribute, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  impl_->attribute(dataset, attribute, type, value.c_str());
}

void Hdf5Writer::integer(const std::string& dataset, const char* attribute, long long value) {
  impl_->attribute(dataset, attribute, H5T_NATIVE_LLONG, &value);
}

std::string Hdf5Writer::bytes() {
  hsize_t size = 0;
  check(H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) >= 0 && H5Fget_filesize(impl_->file, &size) >= 0, "the file");
  impl_->image.resize(size);
  const herr_t closed = H5Fclose(impl_->file);
  impl_->file = -1;
  check(closed >= 0, "the file");
  impl_->image.resize(std::min(impl_->image.size(), end_of_file(impl_->image)));
  check(impl_->image.size() > hdf5::kUserBlock, "the file");
  impl_->image.replace(0, hdf5::kUserBlock, hdf5::user_block(std::string_view(impl_->image).substr(hdf5::kUserBlock)));
  return std::move(impl_->image);
}

}  // namespace evenglow::tracer

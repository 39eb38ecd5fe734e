#include "tracer/polarized_bsdf/hdf5_reader.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <hdf5.h>

#include "core/base/error.h"
#include "tracer/polarized_bsdf/hdf5_library.h"

namespace evenglow::tracer {

using hdf5::Handle;

namespace {

constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
constexpr hsize_t kLargestChunk = 1 << 20;  ///< bytes; inflated it stays near 1 GB even if it was made to burst
constexpr std::size_t kLongestText = 1 << 16;

}  // namespace

struct Hdf5Reader::Impl {
  std::string name;
  hdf5::Quiet quiet{};
  hid_t file = -1;

  ~Impl() {
    if (file >= 0) H5Fclose(file);
  }
  [[noreturn]] void refuse(const std::string& key, std::string message) const {
    throw core::ConfigError(core::Fault{name, 0, 0, key, std::move(message)});
  }
  std::string key(const std::string& dataset, const char* attribute) const {
    return dataset.empty() ? std::string(attribute) : dataset + "." + attribute;
  }
  void require_plain_storage(hid_t dataset, const std::string& key, std::size_t numbers) const;
};

Hdf5Reader::Hdf5Reader(std::string_view bytes, std::string name) : impl_(std::make_unique<Impl>()) {
  impl_->name = std::move(name);
  if (bytes.starts_with(hdf5::kUserBlockTitle)) {
    const std::size_t block = std::min(bytes.size(), hdf5::kUserBlock);
    if (bytes.substr(0, block) != hdf5::user_block(bytes.substr(block))) {
      impl_->refuse({}, "must have the SHA-256 that its first line tells, got another (cut short, damaged or edited)");
    }
  } else if (!bytes.starts_with(kSignature)) {
    impl_->refuse({}, "must be an HDF5 file, got none (its first bytes are others)");
  }
  const Handle access(hdf5::memory_access(bytes), H5Pclose);
  impl_->file = H5Fopen(hdf5::unique_name().c_str(), H5F_ACC_RDONLY, access);
  if (impl_->file < 0) {
    impl_->refuse({}, "must be a whole HDF5 file, got one that the library cannot open (cut short or damaged)");
  }
}

Hdf5Reader::~Hdf5Reader() = default;

// By index or by iteration the library makes a table of all links, and frees twice what it could not read of it (HDF5
// 1.10.8, a damaged root group): links are looked up by their names alone.
std::size_t Hdf5Reader::links() const {
  H5G_info_t group;
  if (H5Gget_info(impl_->file, &group) < 0) impl_->refuse({}, "must have a root group, got a damaged one");
  return group.nlinks;
}

bool Hdf5Reader::has(const std::string& dataset) const {
  const htri_t there = H5Lexists(impl_->file, dataset.c_str(), H5P_DEFAULT);
  if (there < 0) impl_->refuse({}, "must have a root group, got a damaged one");
  if (there == 0) return false;
  H5L_info_t link;
  H5O_info_t object;
  const bool plain = H5Lget_info(impl_->file, dataset.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD &&
                     H5Oget_info_by_name2(impl_->file, dataset.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT) >= 0 &&
                     object.type == H5O_TYPE_DATASET;
  if (!plain) impl_->refuse(dataset, "must be a dataset of this file, got something else");
  return true;
}

std::optional<std::string> Hdf5Reader::text(const std::string& dataset, const char* attribute) const {
  const char* object = dataset.empty() ? "/" : dataset.c_str();
  if (H5Aexists_by_name(impl_->file, object, attribute, H5P_DEFAULT) <= 0) return std::nullopt;
  const std::string key = impl_->key(dataset, attribute);
  const Handle id(H5Aopen_by_name(impl_->file, object, attribute, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(id), H5Sclose);
  const Handle type(H5Aget_type(id), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) {
    impl_->refuse(key, "must be a text, got an attribute of another type");
  }
  if (H5Tis_variable_str(type) > 0) {
    char* value = nullptr;
    if (H5Aread(id, type, static_cast<void*>(&value)) < 0 || value == nullptr) {
      impl_->refuse(key, "must be a text, got a damaged one");
    }
    const std::string result(value);
    H5free_memory(value);
    return result;
  }
  std::string value(std::min(H5Tget_size(type), kLongestText + 1), '\0');
  if (value.size() > kLongestText) impl_->refuse(key, "must be a text of at most 64 KiB, got a longer one");
  if (H5Aread(id, type, value.data()) < 0) impl_->refuse(key, "must be a text, got a damaged one");
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

std::optional<long long> Hdf5Reader::integer(const std::string& dataset, const char* attribute) const {
  const char* object = dataset.empty() ? "/" : dataset.c_str();
  if (H5Aexists_by_name(impl_->file, object, attribute, H5P_DEFAULT) <= 0) return std::nullopt;
  const Handle id(H5Aopen_by_name(impl_->file, object, attribute, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(id), H5Sclose);
  const Handle type(H5Aget_type(id), H5Tclose);
  long long value = 0;
  if (H5Tget_class(type) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(id, H5T_NATIVE_LLONG, &value) < 0) {
    impl_->refuse(impl_->key(dataset, attribute), "must be a whole number, got an attribute of another type");
  }
  return value;
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  const Handle id(H5Dopen2(impl_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  if (id.failed()) impl_->refuse(dataset, "must be a dataset, got a damaged one");
  const Handle type(H5Dget_type(id), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Tget_size(type) > 8) {
    impl_->refuse(dataset, "must hold real numbers of at most 64 bits, got another type");
  }
  const Handle space(H5Dget_space(id), H5Sclose);
  if (H5Sget_simple_extent_type(space) != H5S_SIMPLE) impl_->refuse(dataset, "must be an array, got none");
  std::array<hsize_t, H5S_MAX_RANK> sizes{};
  const int rank = H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return {sizes.begin(), sizes.begin() + std::max(rank, 0)};
}

/// Bytes of the file itself, in pieces that cannot burst.
void Hdf5Reader::Impl::require_plain_storage(hid_t dataset, const std::string& key, std::size_t numbers) const {
  const Handle made(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(made);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(made) != 0) {
    refuse(key, "must be stored in this file, got a reference to another");
  }
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (layout != H5D_CHUNKED) {
    if (H5Dget_storage_size(dataset) == numbers * H5Tget_size(type)) return;
    refuse(key, "must be written whole, got a dataset that was never written or is damaged");
  }
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  const int rank = H5Pget_chunk(made, H5S_MAX_RANK, chunk.data());
  hsize_t chunk_bytes = H5Tget_size(type);
  for (int i = 0; i < rank; ++i)
    chunk_bytes *= std::min<hsize_t>(chunk[static_cast<std::size_t>(i)], kLargestChunk + 1);
  bool known = rank > 0 && chunk_bytes <= kLargestChunk;
  for (int i = 0; i < H5Pget_nfilters(made); ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(made, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32) known = false;
  }
  if (!known) refuse(key, "must have chunks of at most 1 MiB and filters deflate, shuffle, fletcher32, got others");
  hsize_t count = 0, expected = 1;
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::array<hsize_t, H5S_MAX_RANK> sizes{};
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
    expected *= sizes[i] / chunk[i] + (sizes[i] % chunk[i] == 0 ? 0 : 1);
  }
  bool sound = H5Dget_num_chunks(dataset, space, &count) >= 0;
  if (sound && count < expected) refuse(key, "must be written whole, got a dataset with parts that were never written");
  sound = sound && count == expected;
  for (hsize_t i = 0; sound && i < count; ++i) {
    hsize_t stored = 0;
    sound = H5Dget_chunk_info(dataset, space, i, nullptr, nullptr, nullptr, &stored) >= 0 &&
            stored <= chunk_bytes + chunk_bytes / 64 + 1024;
  }
  if (!sound) refuse(key, "must have sound chunks, got damaged ones");
}

std::vector<double> Hdf5Reader::numbers(const std::string& dataset, std::size_t most) const {
  std::size_t count = 1;
  for (const std::size_t size : shape(dataset)) {
    if (size == 0 || size > most / count) {
      impl_->refuse(dataset, fmt::format("must hold 1 to {} numbers, got {}", most, size == 0 ? "none" : "more"));
    }
    count *= size;
  }
  const Handle id(H5Dopen2(impl_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  impl_->require_plain_storage(id, dataset, count);
  std::vector<double> values(count);
  if (H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    impl_->refuse(dataset, "must be readable, got damaged data");
  }
  return values;
}

}  // namespace evenglow::tracer

#include "tracer/sources/binary_file.h"

#include <bit>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::tracer {
namespace {

static_assert(std::endian::native == std::endian::little, "little_endian() copies the bytes as they are");

std::string reason(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

}  // namespace

BinaryFile::BinaryFile(const std::filesystem::path& file) : name_(core::one_line(file.string())) {
  // Without O_NONBLOCK the opening of a pipe would wait for its writer.
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) refuse("cannot be opened: " + reason(errno));
  struct stat info {};
  const bool known = ::fstat(descriptor_, &info) == 0;
  if (!known || !S_ISREG(info.st_mode)) {
    ::close(std::exchange(descriptor_, -1));
    refuse("must be a regular file");
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
}

BinaryFile::~BinaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

BinaryFile::BinaryFile(BinaryFile&& other) noexcept
    : name_(std::move(other.name_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

void BinaryFile::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw core::Error(fmt::format("{}: cannot be read: {}", name_, reason(errno)));
    if (count == 0) throw core::Error(fmt::format("{}: has become shorter while it was read", name_));
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    at += static_cast<std::uint64_t>(count);
  }
}

void BinaryFile::refuse(const std::string& message) const {
  throw core::ConfigError(core::Fault{name_, 0, 0, "", message});
}

}  // namespace evenglow::tracer

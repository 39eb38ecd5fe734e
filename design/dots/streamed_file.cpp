#include "design/dots/streamed_file.h"

#include <cerrno>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "core/base/durable_file.h"
#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::design {

StreamedFile::StreamedFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  const int descriptor = core::open_anew(part_);
  if (descriptor >= 0) file_.reset(::fdopen(descriptor, "wb"));
  if (file_ == nullptr) {
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    errno = reason;
    fail();
  }
}

StreamedFile::~StreamedFile() {
  if (file_ == nullptr) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void StreamedFile::fail() const {
  throw core::Error("cannot write " + core::one_line(path_.string()) + ": " +
                    std::error_code(errno, std::generic_category()).message());
}

void StreamedFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
}

void StreamedFile::finish() {
  if (std::fflush(file_.get()) != 0) fail();
  if (std::fclose(file_.release()) != 0) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    fail();
  }
  std::error_code failure;
  std::filesystem::rename(part_, path_, failure);
  if (!failure) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  throw core::Error("cannot write " + core::one_line(path_.string()) + ": " + failure.message());
}

}  // namespace evenglow::design

#include "app/output_lock.h"

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/config/message_text.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = ".evenglow-lock";

[[noreturn]] void refuse(const fs::path& directory, int descriptor) {
  std::array<char, 32> text{};
  const ssize_t count = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string holder = count > 0 ? std::string(text.data(), static_cast<std::size_t>(count)) : "";
  ::close(descriptor);
  if (holder.empty() || holder.find_first_not_of("0123456789") != std::string::npos) holder.clear();
  throw core::ConfigError(core::Fault{core::one_line(directory.string()), 0, 0, "",
                                      "must not be in use by another run, got one that is at work in it" +
                                          (holder.empty() ? "" : " (process " + holder + ")") +
                                          "; wait for it, or choose another directory with -o"});
}

bool lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EINTR) return errno != EWOULDBLOCK;  // a file system without locks lets every run pass
  }
  return true;
}

/// A run that ends removes its lock file: a lock on a file that has gone guards nothing.
bool is_in_place(int descriptor, const fs::path& file) {
  struct stat held {};
  struct stat named {};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

}  // namespace

OutputLock::OutputLock(const fs::path& directory) : file_(directory / kLockName) {
  while (true) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) {
      throw core::Error("cannot write to " + core::one_line(directory.string()) + ": " +
                        std::error_code(errno, std::generic_category()).message());
    }
    if (!lock(descriptor_)) refuse(directory, std::exchange(descriptor_, -1));
    if (is_in_place(descriptor_, file_)) break;
    ::close(descriptor_);
  }
  const std::string number = std::to_string(::getpid());
  // Who holds it is told for convenience alone: on a full disk the lock holds as well.
  [[maybe_unused]] const bool told =
      ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, number.data(), number.size(), 0) > 0;
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

void OutputLock::check() const {
  if (is_in_place(descriptor_, file_)) return;
  throw core::Error("cannot write to " + core::one_line(file_.parent_path().string()) + ": its " + kLockName +
                    " has gone or is of another run (the directory was removed, moved or taken over)");
}

OutputLock::~OutputLock() {
  if (descriptor_ < 0) return;
  if (is_in_place(descriptor_, file_)) ::unlink(file_.c_str());
  ::close(descriptor_);
}

void check_not_in_use(const fs::path& directory) {
  const int descriptor = ::open((directory / kLockName).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return;
  if (!lock(descriptor)) refuse(directory, descriptor);
  ::close(descriptor);
}

}  // namespace evenglow::app

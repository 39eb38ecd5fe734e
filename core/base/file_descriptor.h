#pragma once

#include <cerrno>
#include <system_error>

#include <unistd.h>

namespace evenglow::core {

/// What the last call of the system failed with.
inline std::error_code last_system_error() {
  return {errno, std::generic_category()};
}

/// Owns an open file of the system; below 0: none.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  /// Some file systems tell only here that a write has failed.
  std::error_code close() {
    const int closing = number_;
    number_ = -1;
    return ::close(closing) == 0 ? std::error_code() : last_system_error();
  }

 private:
  int number_;
};

}  // namespace evenglow::core

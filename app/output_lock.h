#pragma once

#include <filesystem>

namespace evenglow::app {

/// While it lives, no other run may write to the directory: a lock (flock) on `.evenglow-lock` in it. The kernel lets
/// go of it whatever ends the process, so that a file left behind by a killed run locks nothing. File systems without
/// such locks let every run pass.
class OutputLock {
 public:
  /// Throws ConfigError, with the number of the other process, if another run holds it.
  explicit OutputLock(const std::filesystem::path& directory);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&&) = delete;

  /// Before each writing: throws Error if the lock has gone with its directory, in which another run may be at work.
  void check() const;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Throws ConfigError if another run holds the lock of the directory; makes nothing.
void check_not_in_use(const std::filesystem::path& directory);

}  // namespace evenglow::app

#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace evenglow::design {

/// A large file written piece by piece beside its name and moved into place when it is whole: nobody ever reads half of
/// it, and one that is given up leaves nothing. Throws core::Error that names the path if it cannot be written.
class StreamedFile {
 public:
  explicit StreamedFile(std::filesystem::path path);
  ~StreamedFile();
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;

  void write(std::string_view bytes);
  /// Must be the last call.
  void finish();

 private:
  [[noreturn]] void fail() const;

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_, part_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace evenglow::design

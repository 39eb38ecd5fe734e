#include "core/config/text_file.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/file_descriptor.h"
#include "core/config/message_text.h"

namespace evenglow::core {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw ConfigError(Fault{one_line(file.string()), 0, 0, "", message});
}

std::string reason(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

std::string too_large(std::size_t max_bytes) {
  return fmt::format("must not be larger than {} MiB", max_bytes >> 20);
}

/// Refuses by what `stat` tells, without reading.
void check_kind_and_size(const std::filesystem::path& file, const struct stat& info, std::size_t max_bytes) {
  if (S_ISDIR(info.st_mode)) refuse(file, "must be a file, got a directory");
  if (!S_ISREG(info.st_mode)) refuse(file, "must be a regular file, got a pipe, socket or device");
  if (static_cast<unsigned long long>(info.st_size) <= max_bytes) return;
  refuse(file, fmt::format("{}, got {:.1f} MiB", too_large(max_bytes),
                           static_cast<double>(info.st_size) / (1024.0 * 1024.0)));
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes) {
  if (file.empty()) refuse("", "must be the name of a file, got an empty name");
  // Without O_NONBLOCK the opening of a pipe would wait for its writer.
  const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (descriptor.number() < 0) refuse(file, "cannot be opened: " + reason(errno));
  struct stat info {};
  if (::fstat(descriptor.number(), &info) != 0) refuse(file, "cannot be examined: " + reason(errno));
  check_kind_and_size(file, info, max_bytes);
  std::string text;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::read(descriptor.number(), buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(file, "cannot be read: " + reason(errno));
    if (count == 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
    if (text.size() > max_bytes) refuse(file, too_large(max_bytes));
  }
}

void require_text(std::string_view text, const std::string& file_name) {
  const auto position = first_non_text(text);
  if (!position) return;
  const std::string_view before = text.substr(0, *position);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  throw ConfigError(Fault{one_line(file_name), static_cast<int>(lines) + 1,
                          static_cast<int>(*position - line_start) + 1, "",
                          fmt::format("must be UTF-8 text, got the byte 0x{:02x}",
                                      static_cast<unsigned>(static_cast<unsigned char>(text[*position])))});
}

}  // namespace evenglow::core

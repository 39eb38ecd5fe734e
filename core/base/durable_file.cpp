#include "core/base/durable_file.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/file_descriptor.h"

namespace evenglow::core {
namespace {

namespace fs = std::filesystem;

/// Writes and flushes; what went wrong, if anything.
std::error_code write_flushed(const fs::path& file, std::string_view text) {
  FileDescriptor out(open_anew(file));
  if (out.number() < 0) return last_system_error();
  while (!text.empty()) {
    const ssize_t count = ::write(out.number(), text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return last_system_error();
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fsync(out.number()) != 0) return last_system_error();
  return out.close();
}

/// Has so many bytes set aside for a file, and flushes; what went wrong, if anything.
std::error_code reserve_flushed(const fs::path& file, std::size_t bytes) {
  FileDescriptor out(open_anew(file));
  if (out.number() < 0) return last_system_error();
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(out.number(), 0, static_cast<off_t>(bytes));
  if (error != 0) return {error, std::generic_category()};
  if (::fsync(out.number()) != 0) return last_system_error();
  return out.close();
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A folder that cannot be flushed (some network file systems) is no reason to lose a run: the file is there.
void flush_folder(const fs::path& folder) {
  const FileDescriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.number() >= 0) ::fsync(descriptor.number());
}

[[noreturn]] void fail(const fs::path& file, const std::error_code& reason) {
  throw Error("cannot write " + file.string() + ": " + reason.message());
}

fs::path write_beside(const fs::path& file, std::string_view content) {
  fs::path beside = file;
  beside += ".part";
  const std::error_code failure = write_flushed(beside, content);
  if (!failure) return beside;
  std::error_code ignored;
  fs::remove(beside, ignored);
  fail(file, failure);
}

void put_in_place(const fs::path& beside, const fs::path& file) {
  std::error_code failure;
  fs::rename(beside, file, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    fail(file, failure);
  }
  flush_folder(folder_of(file));
}

/// A second name for the file, or (where the file system knows no such names) the file itself moved.
void keep_as(const fs::path& file, const fs::path& previous) {
  std::error_code failure;
  if (!fs::exists(file, failure)) return;
  fs::path link = previous;
  link += ".part";
  fs::remove(link, failure);
  fs::create_hard_link(file, link, failure);
  if (failure) fs::rename(file, link, failure);
  if (!failure) fs::rename(link, previous, failure);
  if (failure) fail(previous, failure);
}

}  // namespace

int open_anew(const fs::path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) return -1;
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
}

void write_durably(const fs::path& file, std::string_view content) {
  put_in_place(write_beside(file, content), file);
}

void write_durably_keeping(const fs::path& file, const fs::path& previous, std::string_view content) {
  const fs::path beside = write_beside(file, content);
  keep_as(file, previous);
  put_in_place(beside, file);
}

void prove_writable(const fs::path& folder, std::size_t bytes) {
  const fs::path probe = folder / ".evenglow-probe";
  const std::error_code failure = reserve_flushed(probe, bytes);
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (failure) throw Error("cannot write to " + folder.string() + ": " + failure.message());
}

}  // namespace evenglow::core

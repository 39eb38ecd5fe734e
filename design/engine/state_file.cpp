#include "design/engine/state_file.h"

#include <string_view>
#include <system_error>

#include "core/base/durable_file.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/config/text_file.h"

namespace evenglow::design {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeal = "{\"sha256\":\"";
constexpr std::size_t kDigits = 64;
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

/// Reads one of the two files; the reason if it is not good.
std::string attempt(const fs::path& file, const std::function<void(const std::string&)>& read) {
  try {
    read(unsealed_state(core::read_text_file(file, kMaxBytes)));
    return "";
  } catch (const std::exception& error) {
    return file.string() + ": the checkpoint cannot be used (" + error.what() + ")";
  }
}

}  // namespace

fs::path previous_state(const fs::path& file) {
  return file.parent_path() / (file.stem().string() + ".previous" + file.extension().string());
}

std::string sealed_state(const std::string& object) {
  core::expects(object.size() > 2 && object.front() == '{', "a state is a JSON object");
  std::string text(kSeal);
  text += core::sha256_hex(object);
  text += "\",";
  return text.append(object, 1, std::string::npos);
}

std::string unsealed_state(const std::string& text) {
  const std::size_t end = kSeal.size() + kDigits;
  if (!text.starts_with(kSeal) || text.size() < end + 3 || text.substr(end, 2) != "\",")
    throw core::Error("it has no checksum: cut short, altered, or of another version");
  std::string object = text.substr(end + 1);
  object.front() = '{';
  if (core::sha256_hex(object) != std::string_view(text).substr(kSeal.size(), kDigits))
    throw core::Error("its checksum is wrong: cut short or altered");
  return object;
}

void save_state(const fs::path& file, const std::string& object) {
  // A damaged one that was there must not take the place of the good one of the step before.
  std::error_code ignored;
  if (fs::exists(file, ignored) && !attempt(file, [](const std::string&) {}).empty()) fs::remove(file, ignored);
  core::write_durably_keeping(file, previous_state(file), sealed_state(object));
}

bool load_state(const fs::path& file, const std::function<void(const std::string&)>& read, std::string& note) {
  std::error_code ignored;
  const fs::path previous = previous_state(file);
  const bool has_newest = fs::exists(file, ignored);
  const bool has_previous = fs::exists(previous, ignored);
  if (!has_newest && !has_previous) return false;
  const std::string fault =
      has_newest ? attempt(file, read) : file.string() + ": the checkpoint cannot be used (there is none)";
  if (fault.empty()) return true;
  if (!has_previous || !attempt(previous, read).empty()) throw core::Error(fault);
  note = fault + "; the one of the step before is used, " + previous.filename().string();
  return true;
}

void remove_state(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
  fs::remove(previous_state(file), ignored);
}

}  // namespace evenglow::design

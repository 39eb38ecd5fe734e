#include "app/rank_role.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include "app/batch_earlier.h"
#include "app/output_lock.h"
#include "core/base/durable_file.h"
#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"
#include "core/montecarlo/batches.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

/// The host and the processors that this process may use: ranks with the same words share them.
std::string place_of_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  cpu_set_t processors;
  CPU_ZERO(&processors);
  ::sched_getaffinity(0, sizeof(processors), &processors);
  return std::string(host.data()) + '\n' + std::string(reinterpret_cast<const char*>(&processors), sizeof(processors));
}

/// Of the processors that ranks share, each takes its part.
int own_threads(core::RankGroup& ranks, const std::stop_token& stop) {
  const std::string own = place_of_process();
  const auto all = ranks.texts(own, stop);
  const auto sharing = static_cast<int>(std::count(all.begin(), all.end(), own));
  return std::max(1, core::effective_threads(0) / std::max(1, sharing));
}

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "evenglow-rank-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw core::Error("cannot make a folder " + name + ": " +
                      std::error_code(errno, std::generic_category()).message());
  return name;
}

constexpr std::size_t kMaxStateBytes = std::size_t{1} << 30;  // of all states; as of one on the disk

void append(std::string& bytes, const std::string& part) {
  const std::uint64_t size = part.size();
  bytes.append(reinterpret_cast<const char*>(&size), sizeof(size));
  bytes += part;
}

std::string next_part(const std::string& bytes, std::size_t& at) {
  std::uint64_t size = 0;
  core::expects(bytes.size() - at >= sizeof(size), "a state is whole");
  std::memcpy(&size, bytes.data() + at, sizeof(size));
  at += sizeof(size);
  core::expects(bytes.size() - at >= size, "a state is whole");
  at += size;
  return bytes.substr(at - size, size);
}

/// `checkpoint.json`, `checkpoint_1.json`, both with `.previous`, and `batch.json`: what a run goes on from.
bool is_state_name(std::string_view name) {
  if (name == kBatchSummary) return true;
  if (!name.starts_with("checkpoint") || !name.ends_with(".json")) return false;
  name.remove_prefix(std::string_view("checkpoint").size());
  name.remove_suffix(std::string_view(".json").size());
  if (name.ends_with(".previous")) name.remove_suffix(std::string_view(".previous").size());
  return name.empty() ||
         (name.size() > 1 && name.front() == '_' && name.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

}  // namespace

void keep_quiet() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

std::string packed_state(const fs::path& directory) {
  std::string bytes;
  std::error_code ignored;
  const auto append_states = [&](const fs::path& folder, const std::string& prefix) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      const std::string name = entry.path().filename().string();
      if (!is_state_name(name) || entry.is_symlink(ignored) || !entry.is_regular_file(ignored)) continue;
      append(bytes, prefix + name);
      append(bytes, core::read_text_file(entry.path(), kMaxStateBytes));
      if (bytes.size() > kMaxStateBytes)
        throw core::Error("the states in " + core::one_line(directory.string()) + " are too large for other ranks");
    }
  };
  append_states(directory, "");
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, ignored)) {
    if (entry.is_symlink(ignored) || !entry.is_directory(ignored)) continue;
    append_states(entry.path(), entry.path().filename().string() + '/');
  }
  return bytes;
}

void unpack_state(const std::string& bytes, const fs::path& directory) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string name = next_part(bytes, at);
    const std::size_t slash = name.find('/');
    const std::string folder = slash == std::string::npos ? "" : name.substr(0, slash);
    const bool known = is_state_name(slash == std::string::npos ? name : name.substr(slash + 1));
    const bool below = slash == std::string::npos || folder.find_first_not_of('.') != std::string::npos;
    if (!known || !below) throw core::Error("a state for other ranks has the name " + core::shown(name));
    const fs::path file = directory / name;
    fs::create_directories(file.parent_path());
    core::write_durably(file, next_part(bytes, at));
  }
}

RankRole::RankRole(core::RankGroup& ranks, const Options& options, const fs::path& directory,
                   const std::stop_token& stop)
    : options_(options) {
  if (ranks.count() == 1) return;
  options_.ranks = &ranks;
  if (options_.threads == 0) options_.threads = own_threads(ranks, stop);
  if (ranks.rank() > 0) {
    own_folder_ = new_folder();
    options_.out = own_folder_ / "out";
    options_.helper = options_.quiet = true;
    options_.json_progress = false;
  }
  if (!options.resume) return;
  if (ranks.rank() == 0) check_not_in_use(directory);  // else the state may change while it is sent
  const std::string state = ranks.texts(ranks.rank() == 0 ? packed_state(directory) : "", stop).front();
  if (ranks.rank() == 0 || state.empty()) return;
  fs::create_directories(options_.out);
  unpack_state(state, options_.out);
}

RankRole::~RankRole() {
  if (own_folder_.empty()) return;
  std::error_code ignored;
  fs::remove_all(own_folder_, ignored);
}

}  // namespace evenglow::app

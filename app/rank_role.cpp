#include "app/rank_role.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include "core/base/error.h"
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
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory, ignored)) {
    const bool folder = entry.is_directory(ignored);
    if (!folder && (!entry.is_regular_file(ignored) || entry.path().extension() != ".json")) continue;
    append(bytes, fs::relative(entry.path(), directory).string() + (folder ? "/" : ""));
    if (folder) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    append(bytes, std::string(std::istreambuf_iterator<char>(in), {}));
  }
  return bytes;
}

void unpack_state(const std::string& bytes, const fs::path& directory) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string name = next_part(bytes, at);
    if (name.ends_with('/')) {
      fs::create_directories(directory / name);
      continue;
    }
    std::ofstream(directory / name, std::ios::binary) << next_part(bytes, at);
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

#include "app/text_output.h"

#include <system_error>

#include "core/base/durable_file.h"
#include "core/base/error.h"

namespace evenglow::app {

void require_free(const std::vector<std::filesystem::path>& paths) {
  std::vector<core::Fault> faults;
  for (const auto& path : paths) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) continue;
    faults.push_back({path.string(), 0, 0, {}, "must be a new file, got one that is there (--overwrite replaces it)"});
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
}

void require_other_than_inputs(const std::vector<std::filesystem::path>& outputs,
                               const std::vector<std::filesystem::path>& inputs) {
  std::vector<core::Fault> faults;
  for (const auto& output : outputs) {
    for (const auto& input : inputs) {
      std::error_code error;
      if (!std::filesystem::equivalent(output, input, error)) continue;
      faults.push_back({output.string(), 0, 0, {}, "must be another file than the input"});
      break;
    }
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
}

void write_whole(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  core::write_durably(path, text);
}

}  // namespace evenglow::app

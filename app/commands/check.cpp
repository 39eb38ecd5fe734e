#include <fmt/core.h>

#include "app/commands/commands.h"
#include "app/run_file.h"

namespace evenglow::app {

int check_command(const Session& session) {
  std::vector<core::Fault> faults;
  for (const auto& file : session.options.files) {
    try {
      for (const Run& run : read_variants(file, session.options)) {
        fmt::print("{}{}: good\n", file.string(), run.variant.empty() ? "" : " (variant " + run.variant + ")");
      }
    } catch (const core::ConfigError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw core::ConfigError(std::move(faults));
  return kDone;
}

}  // namespace evenglow::app

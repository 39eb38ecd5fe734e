#pragma once

#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "app/dots_input.h"

namespace CLI {
class App;
}

namespace evenglow::app {

struct Session;

/// `evenglow dots`: from the density of a design to real dots and their files; or, of a pattern that exists, its
/// figures and files.
class DotsCommand {
 public:
  DotsCommand() = default;
  DotsCommand(const DotsCommand&) = delete;
  DotsCommand& operator=(const DotsCommand&) = delete;

  /// Adds the command to the program. It must stay where it is until the program is done.
  void add_to(CLI::App& program);
  bool chosen() const { return chosen_; }
  /// Returns the exit code; wrong input leaves as `core::ConfigError`.
  int run(const Session& session);

 private:
  void add_key(CLI::App& command, const char* key, const char* help, const char* type);
  DotsOverrides overrides() const;
  int place(const std::filesystem::path& out, const std::stop_token& stop) const;
  int import_pattern(const std::filesystem::path& out, const std::stop_token& stop) const;

  bool chosen_ = false;
  std::filesystem::path source_, run_file_, out_;
  std::map<std::string, std::string> keys_;  ///< of the map `dots`, as typed
  std::vector<std::string> set_;
  bool accept_shortfall_ = false, overwrite_ = false, quiet_ = false;
  int threads_ = 0;
};

}  // namespace evenglow::app

#pragma once

#include <string>
#include <vector>

#include "app/options.h"

namespace CLI {
class App;
}

namespace evenglow::app {

struct Session;

/// `evenglow bench-design`: how fast each updater reaches 5, 2, 1 and 0.5 % of noise-corrected RMS.
class BenchDesignCommand {
 public:
  BenchDesignCommand() = default;
  BenchDesignCommand(const BenchDesignCommand&) = delete;
  BenchDesignCommand& operator=(const BenchDesignCommand&) = delete;

  /// Adds the command to the program. It must stay where it is until the program is done.
  void add_to(CLI::App& program);
  bool chosen() const { return chosen_; }
  /// Returns the exit code; wrong input leaves as `core::ConfigError`.
  int run(const Session& session);

 private:
  bool chosen_ = false;
  bool full_ = false;
  int seeds_ = 5;
  double cpu_s_ = 600.0;
  std::vector<std::string> updaters_;
  Options options_;
};

}  // namespace evenglow::app

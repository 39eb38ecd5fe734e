#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace evenglow::tests {

/// What a program left behind.
struct ProgramResult {
  int code = -1;           ///< its exit code, or 128 + the number of the signal that ended it
  std::string out;         ///< stdout
  std::string err;         ///< stderr
  double cpu_s = 0.0;      ///< all threads, user and system
  bool timed_out = false;  ///< it was killed

  std::vector<std::string> err_lines() const;
};

/// A running program, its stdin empty and its output kept. Killed at the end of its life if it still runs.
class Program {
 public:
  /// `words` begins with the path of the program; `folder` is its working directory (empty: ours).
  Program(const std::vector<std::string>& words, const std::filesystem::path& folder = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const;
  bool is_running();
  /// Waits for the end, at most `patience_s`, then kills.
  ProgramResult wait(double patience_s = 120.0);

 private:
  bool reap(bool block);

  TempFolder output_;
  int pid_ = -1;  ///< -1: it has ended
  ProgramResult result_;
};

/// Runs a program to its end.
ProgramResult run_program(const std::vector<std::string>& words, const std::filesystem::path& folder = {},
                          double patience_s = 120.0);

}  // namespace evenglow::tests

#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "design/problem/judgment.h"

namespace evenglow::app {

/// Progress on stderr: a bar that is drawn again on a terminal, plain lines otherwise, nothing when quiet.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What the next bars and lines are about (`lpp: step 3`).
  void begin(const std::string& label);
  void photons(std::uint64_t done, std::uint64_t all);
  /// Ends the bar with a line that stays.
  void line(const std::string& text);

 private:
  void clear();

  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::string label_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
  std::mutex mutex_;
};

/// One step in words.
std::string describe(const design::StepRecord& record);

}  // namespace evenglow::app

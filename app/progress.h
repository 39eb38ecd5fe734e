#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "design/problem/judgment.h"

namespace evenglow::app {

/// Progress on stderr: a bar that is drawn again on a terminal, plain lines otherwise, nothing when quiet. For
/// programs, one JSON object a line instead, at most ten a second besides the lines that stay:
/// `{"event": "photons", "label": "lpp: step 3", "done": 400000, "all": 1000000, "photons_per_s": 2.1e6, "left_s":
/// 0.3}`,
/// `{"event": "line", "text": "..."}` and, after each design step, `{"event": "step", "label": "lpp", "step": 3, ...}`
/// with the columns of convergence.csv.
class Progress {
 public:
  explicit Progress(bool quiet, bool json = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What the next bars and lines are about (`lpp: step 3`).
  void begin(const std::string& label);
  /// Stands before every label and line from now on (`[3/20] `).
  void prefix(const std::string& text);
  void photons(std::uint64_t done, std::uint64_t all);
  /// Ends the bar with a line that stays.
  void line(const std::string& text);
  /// A finished design step of `label` (may be empty).
  void step(const std::string& label, const design::StepRecord& record);

 private:
  void clear();
  void write(const std::string& text);
  void draw(std::uint64_t done, std::uint64_t all, double rate, double left);

  bool quiet_;
  bool json_;
  bool terminal_;
  bool drawn_ = false;
  std::string prefix_;
  std::string label_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
  std::mutex mutex_;
};

/// What ends a program or a run of a batch, on stderr: `text` as it is, or for programs `{"event": "fault", "text":
/// "..."}`. `event` is `fault` for wrong input, else `failure`. A full disk below stderr is passed over.
void tell(const std::string& event, const std::string& text, bool json);

/// One step in words.
std::string describe(const design::StepRecord& record);

}  // namespace evenglow::app

#include "app/progress.h"

#include <cstdio>

#include <fmt/core.h>
#include <unistd.h>

namespace evenglow::app {
namespace {

constexpr int kBarWidth = 24;

std::string bar(double share) {
  const int filled = static_cast<int>(share * kBarWidth);
  return std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kBarWidth - filled), '.');
}

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::begin(const std::string& label) {
  const std::lock_guard lock(mutex_);
  label_ = label;
  start_ = last_ = std::chrono::steady_clock::now();
}

void Progress::photons(std::uint64_t done, std::uint64_t all) {
  if (quiet_ || !terminal_) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (done < all && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / (seconds > 0.0 ? seconds : 1e-9);
  const double left = static_cast<double>(all - done) / rate;
  fmt::print(stderr, "\r\033[K{} [{}] {:.2f} million photons/s, {:.0f} s left", label_,
             bar(static_cast<double>(done) / static_cast<double>(all)), rate * 1e-6, left);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::line(const std::string& text) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  clear();
  fmt::print(stderr, "{}\n", text);
  std::fflush(stderr);
}

std::string describe(const design::StepRecord& r) {
  return fmt::format(
      "step {}: {:.3g} photons, RMS {:.2f} % (corrected {:.2f} +- {:.2f} %), efficiency {:.2f} %, density {:.4f}, "
      "{:.1f} s",
      r.step, static_cast<double>(r.photons), 100.0 * r.rms, 100.0 * r.rms_corrected.value, 100.0 * r.rms_corrected.se,
      100.0 * r.efficiency.value, r.mean_density, r.wall_s);
}

}  // namespace evenglow::app

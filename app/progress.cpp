#include "app/progress.h"

#include <cstdio>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/config/message_text.h"

namespace evenglow::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kBarWidth = 24;

/// Progress that nobody can be shown (stderr on a full disk) is no reason to end a run.
void to_stderr(const std::string& text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string bar(double share) {
  const int filled = static_cast<int>(share * kBarWidth);
  return std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kBarWidth - filled), '.');
}

}  // namespace

Progress::Progress(bool quiet, bool json)
    : quiet_(quiet), json_(json), terminal_(!json && isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (!drawn_) return;
  to_stderr("\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

void Progress::begin(const std::string& label) {
  const std::lock_guard lock(mutex_);
  label_ = label;
  start_ = last_ = std::chrono::steady_clock::now();
}

void Progress::prefix(const std::string& text) {
  const std::lock_guard lock(mutex_);
  prefix_ = text;
}

void Progress::photons(std::uint64_t done, std::uint64_t all) {
  if (quiet_ || !(terminal_ || json_)) return;
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (done < all && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / (seconds > 0.0 ? seconds : 1e-9);
  draw(done, all, rate, static_cast<double>(all - done) / rate);
}

void Progress::draw(std::uint64_t done, std::uint64_t all, double rate, double left) {
  if (json_) {
    return write(text_of({{"event", "photons"},
                          {"label", prefix_ + label_},
                          {"done", done},
                          {"all", all},
                          {"photons_per_s", rate},
                          {"left_s", left}}));
  }
  to_stderr(fmt::format("\r\033[K{}{} [{}] {:.2f} million photons/s, {:.0f} s left", prefix_, label_,
                        bar(static_cast<double>(done) / static_cast<double>(all)), rate * 1e-6, left));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::write(const std::string& text) {
  clear();
  to_stderr(text + "\n");
  std::fflush(stderr);
}

void Progress::line(const std::string& text) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  // Some of it may come from a file of a stranger (a state): no line of it acts on the terminal.
  write(json_ ? text_of({{"event", "line"}, {"text", prefix_ + text}}) : core::one_line(prefix_ + text));
}

void Progress::step(const std::string& label, const design::StepRecord& r) {
  if (!json_) return line(label.empty() ? describe(r) : label + ": " + describe(r));
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  write(text_of({{"event", "step"},
                 {"label", prefix_ + label},
                 {"step", r.step},
                 {"photons", r.photons},
                 {"rms", r.rms},
                 {"rms_corrected", r.rms_corrected.value},
                 {"rms_corrected_se", r.rms_corrected.se},
                 {"efficiency", r.efficiency.value},
                 {"efficiency_se", r.efficiency.se},
                 {"mean_density", r.mean_density},
                 {"luminance_mean_cd_m2", r.luminance_mean},
                 {"cpu_s", r.cpu_s},
                 {"wall_s", r.wall_s}}));
}

void tell(const std::string& event, const std::string& text, bool json) {
  to_stderr((json ? text_of({{"event", event}, {"text", text}}) : core::one_line(text)) + "\n");
}

std::string describe(const design::StepRecord& r) {
  return fmt::format(
      "step {}: {:.3g} photons, RMS {:.2f} % (corrected {:.2f} +- {:.2f} %), efficiency {:.2f} %, density {:.4f}, "
      "{:.1f} s",
      r.step, static_cast<double>(r.photons), 100.0 * r.rms, 100.0 * r.rms_corrected.value, 100.0 * r.rms_corrected.se,
      100.0 * r.efficiency.value, r.mean_density, r.wall_s);
}

}  // namespace evenglow::app

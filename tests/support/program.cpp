#include "tests/support/program.h"

#include <chrono>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/permissions.h"

namespace evenglow::tests {
namespace {

/// Only what is allowed between fork and exec.
[[noreturn]] void become(char* const* words, const char* folder, const char* out, const char* err) {
  const int in_file = ::open("/dev/null", O_RDONLY);
  const int out_file = ::open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = ::open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const bool ready = in_file >= 0 && out_file >= 0 && err_file >= 0 && ::dup2(in_file, 0) >= 0 &&
                     ::dup2(out_file, 1) >= 0 && ::dup2(err_file, 2) >= 0;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  obey_permissions_after_exec();
  if (ready && (*folder == '\0' || ::chdir(folder) == 0)) ::execv(words[0], words);
  ::_exit(127);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::vector<std::string> ProgramResult::err_lines() const {
  std::vector<std::string> lines;
  std::istringstream text(err);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

Program::Program(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  std::vector<char*> pointers;
  std::vector<std::string> copies = words;
  for (std::string& word : copies) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string out = (output_ / "out").string();
  const std::string err = (output_ / "err").string();
  pid_ = ::fork();
  if (pid_ == 0) become(pointers.data(), folder.c_str(), out.c_str(), err.c_str());
  if (pid_ < 0) throw std::runtime_error("cannot start " + words.front());
}

Program::~Program() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  reap(true);
}

void Program::send(int signal) const {
  if (pid_ > 0) ::kill(pid_, signal);
}

bool Program::is_running() {
  return pid_ > 0 && !reap(false);
}

bool Program::reap(bool block) {
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, block ? 0 : WNOHANG, &usage) != pid_) return false;
  pid_ = -1;
  result_.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result_.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result_.out = file_text(output_ / "out");
  result_.err = file_text(output_ / "err");
  return true;
}

ProgramResult Program::wait(double patience_s) {
  const auto start = std::chrono::steady_clock::now();
  while (is_running()) {
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > patience_s) {
      result_.timed_out = true;
      ::kill(pid_, SIGKILL);
      reap(true);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return result_;
}

ProgramResult run_program(const std::vector<std::string>& words, const std::filesystem::path& folder,
                          double patience_s) {
  return Program(words, folder).wait(patience_s);
}

}  // namespace evenglow::tests

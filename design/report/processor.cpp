#include "design/report/processor.h"

#include <algorithm>
#include <fstream>

namespace evenglow::design {
namespace {

constexpr int kMostLines = 4096;  ///< of a machine with many cores the first one's lines are enough

std::string trimmed(const std::string& text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  const auto first = std::find_if_not(text.begin(), text.end(), blank);
  const auto last = std::find_if_not(text.rbegin(), std::make_reverse_iterator(first), blank).base();
  return {first, last};
}

}  // namespace

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  return processor_name(cpuinfo);
}

std::string processor_name(std::istream& cpuinfo) {
  std::string board;
  std::string line;
  for (int i = 0; i < kMostLines && std::getline(cpuinfo, line); ++i) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string key = trimmed(line.substr(0, colon));
    if (key == "model name") return trimmed(line.substr(colon + 1));
    if (key == "Model" && board.empty()) board = trimmed(line.substr(colon + 1));
  }
  return board;
}

}  // namespace evenglow::design

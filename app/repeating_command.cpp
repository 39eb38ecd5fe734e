#include "app/repeating_command.h"

#include <algorithm>
#include <string_view>

namespace evenglow::app {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("_-+=.,:/@%^").find(c) != std::string_view::npos;
}

}  // namespace

std::string quoted(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string repeating_command(const std::string& command, const Options& options) {
  std::string text = "evenglow " + command;
  for (const auto& file : options.files) text += ' ' + quoted(file.string());
  for (const std::string& change : options.set) text += " --set " + quoted(change);
  if (options.seed) text += " --seed " + quoted(*options.seed);
  if (options.photons) text += " --photons " + quoted(*options.photons);
  if (!options.design.empty()) text += " --design " + quoted(options.design.string());
  if (options.sample) text += " --sample " + std::to_string(*options.sample);
  return text;
}

}  // namespace evenglow::app

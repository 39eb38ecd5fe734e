#include "core/base/error.h"

#include <utility>

namespace evenglow::core {
namespace {

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.to_string();
  }
  return text;
}

}  // namespace

std::string Fault::to_string() const {
  std::string text = file;
  if (line > 0) text += ':' + std::to_string(line);
  if (line > 0 && column > 0) text += ':' + std::to_string(column);
  if (!key.empty()) text += (text.empty() ? "" : ": ") + key;
  if (!text.empty()) text += ": ";
  return text + message;
}

ConfigError::ConfigError(Fault fault) : ConfigError(std::vector<Fault>{std::move(fault)}) {}

ConfigError::ConfigError(std::vector<Fault> faults) : Error(joined(faults)), faults_(std::move(faults)) {}

void broken_promise(std::string_view promise, const std::source_location& where) {
  throw Error(std::string(where.file_name()) + ':' + std::to_string(where.line()) +
              ": broken promise: " + std::string(promise));
}

}  // namespace evenglow::core

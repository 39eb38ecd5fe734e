#pragma once

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace evenglow::core {

/// The base of all that Evenglow throws. Thrown as itself for what is no fault of the input (exit code 1).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One fault of the input, told in one line: `file:line:column: key: what is allowed, what was given`.
struct Fault {
  std::string file;
  int line = 0;         ///< from 1; 0: not known (an option of the command line, a whole file)
  int column = 0;       ///< from 1; 0: not known
  std::string key;      ///< path of the key (`backlight.films[1].axis_deg`), empty for the file as a whole
  std::string message;  ///< what is allowed, what was given

  std::string to_string() const;
};

/// Wrong input (exit code 2). All faults that could be found at once.
class ConfigError : public Error {
 public:
  explicit ConfigError(Fault fault);
  explicit ConfigError(std::vector<Fault> faults);  ///< at least one

  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Throws `Error` with the place.
[[noreturn]] void broken_promise(std::string_view promise, const std::source_location& where);

/// A promise between rooms: throws `Error` with the place of the call when `condition` is false.
inline void expects(bool condition, std::string_view promise,
                    std::source_location where = std::source_location::current()) {
  if (!condition) broken_promise(promise, where);
}

}  // namespace evenglow::core

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace evenglow::tracer {

/// The text of a photometric file, read line by line or number by number with its place. Bytes beyond ASCII are let
/// pass (names of products in old code pages). All faults are `core::ConfigError` with file, line and column.
class PhotometricText {
 public:
  /// Reads the file: at most 16 MiB, no zero bytes.
  explicit PhotometricText(const std::filesystem::path& file);

  bool at_end() const { return position_ >= text_.size(); }
  int line() const { return line_; }  ///< of what is read next, from 1

  /// The rest of the current line without its end and trailing blanks.
  std::string_view next_line(std::string_view what);
  /// The next number; blanks, commas and line ends part numbers. `what` names it in a message: `ballast factor`.
  double number(std::string_view what, double min, double max);
  /// As `number`, and whole.
  std::size_t count(std::string_view what, std::size_t min, std::size_t max);
  /// The number that the next line begins with; a decimal comma counts as a point.
  double number_line(std::string_view what, double min, double max);
  std::size_t count_line(std::string_view what, std::size_t min, std::size_t max);
  /// Faults anything but blanks up to the end of the file.
  void expect_end(std::string_view after_what);

  /// A fault at the place of the word read last.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void skip(std::string_view skipped);
  std::string_view word(std::string_view what);
  double parse(std::string_view word, std::string_view what, double min, double max) const;
  std::size_t whole(double value, std::string_view what) const;

  std::string name_;
  std::string text_;
  std::size_t position_ = 0;
  int line_ = 1;
  std::size_t line_start_ = 0;
  int word_line_ = 1;
  int word_column_ = 1;
};

}  // namespace evenglow::tracer

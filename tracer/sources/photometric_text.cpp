#include "tracer/sources/photometric_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/config/message_text.h"
#include "core/config/text_file.h"

namespace evenglow::tracer {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
// 0x1a ends a text file of old DOS programs.
constexpr std::string_view kBlanks = " \t\r\n\f\x1a";
constexpr std::string_view kParts = " \t\r\n\f\x1a,";

}  // namespace

PhotometricText::PhotometricText(const std::filesystem::path& file)
    : name_(core::one_line(file.string())), text_(core::read_text_file(file, kMaxBytes)) {
  if (text_.starts_with("\xEF\xBB\xBF")) position_ = line_start_ = 3;
  const std::size_t zero = text_.find('\0');
  if (zero == std::string::npos) return;
  word_line_ = static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(zero), '\n')) + 1;
  refuse("must be text, got a zero byte");
}

void PhotometricText::refuse(const std::string& message) const {
  throw core::ConfigError(core::Fault{name_, word_line_, word_column_, "", message});
}

void PhotometricText::skip(std::string_view skipped) {
  while (position_ < text_.size() && skipped.find(text_[position_]) != std::string_view::npos) {
    if (text_[position_++] != '\n') continue;
    ++line_;
    line_start_ = position_;
  }
  word_line_ = line_;
  word_column_ = static_cast<int>(position_ - line_start_) + 1;
}

std::string_view PhotometricText::next_line(std::string_view what) {
  word_line_ = line_;
  word_column_ = static_cast<int>(position_ - line_start_) + 1;
  if (at_end()) refuse(fmt::format("must go on with the {}, got the end of the file", what));
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = std::string_view(text_).substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  ++line_;
  line_start_ = position_;
  while (!line.empty() && kBlanks.find(line.back()) != std::string_view::npos) line.remove_suffix(1);
  return line;
}

std::string_view PhotometricText::word(std::string_view what) {
  skip(kParts);
  if (at_end()) refuse(fmt::format("must go on with the {}, got the end of the file", what));
  const std::size_t end = std::min(text_.find_first_of(kParts, position_), text_.size());
  const std::string_view result = std::string_view(text_).substr(position_, end - position_);
  position_ = end;
  return result;
}

double PhotometricText::parse(std::string_view text, std::string_view what, double min, double max) const {
  const std::string_view given = text;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= min && value <= max)) {
    refuse(fmt::format("{}: must be a number in [{}, {}], got \"{}\"", what, min, max, core::shown(given, 40)));
  }
  return value;
}

std::size_t PhotometricText::whole(double value, std::string_view what) const {
  if (value != std::floor(value)) refuse(fmt::format("{}: must be a whole number, got {}", what, value));
  return static_cast<std::size_t>(value);
}

double PhotometricText::number(std::string_view what, double min, double max) {
  return parse(word(what), what, min, max);
}

std::size_t PhotometricText::count(std::string_view what, std::size_t min, std::size_t max) {
  return whole(number(what, static_cast<double>(min), static_cast<double>(max)), what);
}

double PhotometricText::number_line(std::string_view what, double min, double max) {
  std::string line(next_line(what));
  const std::size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  line = line.substr(begin, line.find_first_of(kBlanks, begin) - begin);
  std::replace(line.begin(), line.end(), ',', '.');
  return parse(line, what, min, max);
}

std::size_t PhotometricText::count_line(std::string_view what, std::size_t min, std::size_t max) {
  return whole(number_line(what, static_cast<double>(min), static_cast<double>(max)), what);
}

void PhotometricText::expect_end(std::string_view after_what) {
  skip(kParts);
  if (at_end()) return;
  refuse(fmt::format("must end after {}, got \"{}\"", after_what, core::shown(word(""), 40)));
}

}  // namespace evenglow::tracer

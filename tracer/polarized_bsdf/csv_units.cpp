#include "tracer/polarized_bsdf/csv_units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include <fmt/format.h>

namespace evenglow::tracer {
namespace {

struct Words {
  std::vector<std::string> words;
  std::vector<int> lines;
};

/// Lower-case words of the comment lines above the header; '/', '^', '-' and '%' belong to a word.
Words comment_words(std::string_view text) {
  Words found;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int line = 1; text.starts_with('#'); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string word;
    for (const char c : std::string(text.substr(0, end)) + ' ') {
      const auto u = static_cast<unsigned char>(c);
      if (std::isalnum(u) || c == '/' || c == '^' || c == '-' || c == '%' || u >= 0x80) {
        word += static_cast<char>(std::tolower(u));
      } else if (!word.empty()) {
        found.words.push_back(std::move(word));
        found.lines.push_back(line);
        word.clear();
      }
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return found;
}

constexpr std::array<std::string_view, 6> kPerSteradian{"1/sr", "sr^-1", "sr-1", "/sr", "sr-", "per-sr"};
constexpr std::array<std::string_view, 4> kDegrees{"degrees", "degree", "deg", "\xC2\xB0"};
constexpr std::array<std::string_view, 3> kNanometers{"nm", "nanometers", "nanometer"};
/// Words that can only be units of what a table gives in degrees or nm.
constexpr std::array<std::string_view, 10> kWrong{"rad",       "radian",      "radians",    "mrad",     "um",
                                                  "\xC2\xB5m", "micrometers", "micrometer", "angstrom", "gon"};

template <std::size_t N>
bool any_of(const Words& found, const std::array<std::string_view, N>& names) {
  return std::ranges::any_of(found.words,
                             [&](const std::string& w) { return std::ranges::find(names, w) != names.end(); });
}

}  // namespace

std::optional<core::Fault> unit_fault(std::string_view text, const std::string& name, bool required) {
  constexpr std::string_view kAllowed = "the comment must name the units degrees, nm and 1/sr";
  const Words found = comment_words(text);
  for (std::size_t i = 0; i < found.words.size(); ++i) {
    if (std::ranges::find(kWrong, found.words[i]) != kWrong.end()) {
      return core::Fault{name, found.lines[i], 1, {}, fmt::format("{}, got '{}'", kAllowed, found.words[i])};
    }
  }
  const auto missing = [&](std::string_view unit) {
    return core::Fault{name, 1, 1, {}, fmt::format("{}, got one without {}", kAllowed, unit)};
  };
  if (found.words.empty()) {
    if (!required) return std::nullopt;
    return core::Fault{name, 1, 1, {}, fmt::format("{} on the first line, got none", kAllowed)};
  }
  const bool steradian = any_of(found, kPerSteradian);
  const auto other = std::ranges::find_if(found.words, [](const std::string& w) {
    return w == "%" || w == "percent" || w == "cd/m2" || w == "cd/m^2" || w == "1/deg" || w == "1/m2";
  });
  if (!steradian && other != found.words.end()) {
    const int line = found.lines[static_cast<std::size_t>(other - found.words.begin())];
    return core::Fault{name, line, 1, {}, fmt::format("{}, got '{}'", kAllowed, *other)};
  }
  // Beside another unit `mm` is that of the wavelength; elsewhere it may be the film's thickness.
  const auto mm = std::ranges::find(found.words, "mm");
  if (mm != found.words.end() && !any_of(found, kNanometers) && (steradian || any_of(found, kDegrees))) {
    const int line = found.lines[static_cast<std::size_t>(mm - found.words.begin())];
    return core::Fault{name, line, 1, {}, fmt::format("{}, got '{}'", kAllowed, *mm)};
  }
  if (!required) return std::nullopt;
  if (!steradian) return missing("1/sr");
  if (!any_of(found, kDegrees)) return missing("degrees");
  if (!any_of(found, kNanometers)) return missing("nm");
  return std::nullopt;
}

}  // namespace evenglow::tracer

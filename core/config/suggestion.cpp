#include "core/config/suggestion.h"

#include <algorithm>
#include <array>

#include "core/config/message_text.h"
#include "core/config/number_text.h"

namespace evenglow::core {
namespace {

constexpr std::size_t kMaxWord = 60;  ///< longer words are no typing mistakes
constexpr std::size_t kMaxListed = 12;

bool is_any_unit(std::string_view text) {
  static constexpr std::array<std::string_view, 24> kKnown{
      "mm",   "um", "nm",  "cm", "m",       "km",       "in",    "inch",   "mil",    "pt",     "deg",    "rad",
      "mrad", "lm", "mlm", "w",  "percent", "fraction", "per_m", "per_mm", "per_cm", "per_um", "micron", "degrees"};
  return std::find(kKnown.begin(), kKnown.end(), text) != kKnown.end();
}

/// The known key that is `key` but for the unit it ends in.
std::optional<std::string> same_but_for_unit(std::string_view key, const std::vector<std::string>& known) {
  for (const std::string& candidate : known) {
    const std::string_view unit = unit_of(candidate);
    if (unit.empty()) continue;
    const auto stem = std::string_view(candidate).substr(0, candidate.size() - unit.size() - 1);
    if (key == stem) return candidate;
    if (!key.starts_with(stem) || key[stem.size()] != '_') continue;
    if (is_any_unit(key.substr(stem.size() + 1))) return candidate;
  }
  return std::nullopt;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kMaxListed); ++i) {
    if (i > 0) text += ", ";
    text += words[i];
  }
  return text + (words.size() > kMaxListed ? ", ..." : "");
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t cost = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + cost});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& options) {
  if (word.size() < 2 || word.size() > kMaxWord) return std::nullopt;
  std::optional<std::string> best;
  std::size_t best_distance = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
  for (const std::string& option : options) {
    const std::size_t distance = edit_distance(word, option);
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = option;
  }
  return best;
}

KeyAdvice advise_on_key(std::string_view key, const std::vector<std::string>& known) {
  if (const auto meant = same_but_for_unit(key, known)) {
    return {"unknown key, the unit must be " + std::string(unit_of(*meant)) + ": `" + *meant + '`', meant};
  }
  if (const auto meant = nearest(key, known)) return {"unknown key, did you mean `" + *meant + "`?", meant};
  const std::string before_colon(key.substr(0, key.find(':')));
  if (std::find(known.begin(), known.end(), before_colon) != known.end()) {
    return {"unknown key, a space must follow the colon", before_colon};
  }
  return {known.empty() ? "unknown key" : "unknown key, known here: " + listed(known)};
}

}  // namespace evenglow::core
